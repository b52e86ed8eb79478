// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of any form as GeoJSON (RFC 7946): a FeatureCollection with a feature for each cell that has rings.
#include <algorithm>
#include <array>
#include <atomic>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/flat_arrays.h"
#include "io/geojson_geometry.h"
#include "io/geojson_properties.h"
#include "io/number.h"
#include "map/arc.h"
#include "map/connected_rings.h"
#include "map/crossing_lines.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

struct RegionsToWrite {
  const CellRings& cells;
  std::span<const Column> columns;
  double tolerance;  // radians
  const Execution& execution;
};

using Polygons = std::vector<map::PolygonWithHoles>;

struct DrawnRegions {
  std::vector<Polygons> cells;
  std::size_t num_crossed = 0;  // how many have lines that cross, which their arcs do not
};

constexpr std::size_t cells_per_task = 16;

// The points of the rings of a cell.
class RingsOfCell {
 public:
  RingsOfCell(const CellRings& cells, std::size_t cell) {
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r) {
      std::vector<Point>& ring = points_.emplace_back();
      ring.reserve(cells.rings[r + 1] - cells.rings[r]);
      for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
        ring.push_back(cells.points[cells.corners[k]]);
      }
    }
    rings_.assign(points_.begin(), points_.end());
  }
  [[nodiscard]] std::span<const map::UnitVectors> rings() const { return rings_; }

 private:
  std::vector<std::vector<Point>> points_;
  std::vector<map::UnitVectors> rings_;
};

double area_of(std::span<const map::UnitVectors> rings) {
  double area = 0;
  for (const map::UnitVectors ring : rings) area += map::area_on_left(ring);
  return area < 0 ? area + 4 * std::numbers::pi : area;
}

DrawnRegions draw(const RegionsToWrite& job, double tolerance) {
  DrawnRegions drawn;
  drawn.cells.resize(job.cells.num_cells());
  std::atomic<std::size_t> num_crossed = 0;
  system::parallel_for(
      job.execution.threads, drawn.cells.size(), cells_per_task,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const RingsOfCell cell(job.cells, i);
          if (cell.rings().empty()) continue;
          bool is_crossed = false;
          for (const std::vector<std::size_t>& part : map::connected_rings(cell.rings())) {
            std::vector<map::UnitVectors> rings;
            rings.reserve(part.size());
            for (const std::size_t r : part) rings.push_back(cell.rings()[r]);
            for (map::PolygonWithHoles& polygon : map::region_polygons(rings, tolerance)) {
              is_crossed = is_crossed || map::have_crossing_lines(polygon.rings);
              drawn.cells[i].push_back(std::move(polygon));
            }
          }
          if (is_crossed) ++num_crossed;
        }
      });
  drawn.num_crossed = num_crossed;
  return drawn;
}

// Arcs that are closer together than the tolerance may cross when they are drawn. Then all are drawn
// closer to what they are, as long as that helps: of all cells, as neighbors share their arcs.
std::vector<Polygons> draw_uncrossed(const RegionsToWrite& job) {
  constexpr int most_attempts = 6;
  double tolerance = job.tolerance;
  DrawnRegions best = draw(job, tolerance);
  for (int i = 0; i < most_attempts && best.num_crossed > 0; ++i) {
    tolerance /= 8;
    DrawnRegions drawn = draw(job, tolerance);
    if (drawn.num_crossed >= best.num_crossed) break;
    best = std::move(drawn);
  }
  return std::move(best.cells);
}

void write_regions_geojson(AtomicFile& file, const RegionsToWrite& job) {
  const std::vector<Polygons> drawn = draw_uncrossed(job);
  std::vector<std::string> geometries(drawn.size());
  system::parallel_for(job.execution.threads, drawn.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           if (job.cells.cells[i] == job.cells.cells[i + 1]) continue;
                           append_geometry(geometries[i], drawn[i]);
                         }
                       });
  const std::vector<std::string> keys = property_keys(job.columns, {"area"});
  file.write(R"({"type":"FeatureCollection","features":[)");
  const char* separator = "\n";
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    if (geometries[i].empty()) continue;
    std::string text = std::exchange(separator, ",\n");
    text += R"({"type":"Feature","properties":{"area":)";
    append_number(text, area_of(RingsOfCell(job.cells, i).rings()));
    for (std::size_t k = 0; k < keys.size(); ++k) {
      text += keys[k];
      append_value(text, job.columns[k], i);
    }
    text += R"(},"geometry":)" + geometries[i] + '}';
    file.write(text);
  }
  file.write("\n]}\n");
}

bool is_complete(const Column& column, std::size_t num_rows) {
  return column.ends.size() == num_rows && std::ranges::is_sorted(column.ends) &&
         (column.ends.empty() || column.ends.back() == column.text.size());
}

constexpr std::array<Writer<RegionsToWrite>, 1> region_writers = {
    {{".geojson", &write_regions_geojson}}};

void require_rings(const CellRings& cells) {
  require_fit(
      !cells.rings.empty() && are_offsets(cells.cells, cells.rings.size() - 1) &&
          are_offsets(cells.rings, cells.corners.size()) &&
          std::ranges::all_of(cells.corners, [&](Index p) { return p < cells.points.size(); }) &&
          are_unit_vectors(cells.points),
      "cells");
}

}  // namespace
}  // namespace rondel::io

namespace rondel {

LonLatRegions region_polygons(const CellRings& cells, double tolerance_deg,
                              const Execution& execution) {
  const system::Call call(execution);
  io::require_rings(cells);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  const std::vector<io::Polygons> drawn = io::draw_uncrossed({cells, {}, tolerance, execution});
  LonLatRegions all;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (const map::PolygonWithHoles& polygon : drawn[i]) {
      for (const std::vector<LonLat>& ring : polygon.rings) {
        all.positions.insert(all.positions.end(), ring.begin(), ring.end());
        all.rings.push_back(all.positions.size());
      }
      all.polygons.push_back(all.rings.size() - 1);
      all.owners.push_back(static_cast<Index>(i));
    }
  }
  return all;
}

void write_regions(const FileName& file, const CellRings& cells, std::span<const Column> columns,
                   double tolerance_deg, const Execution& execution) {
  const system::Call call(execution);
  io::require_rings(cells);
  io::require_fit(std::ranges::all_of(columns,
                                      [&](const Column& column) {
                                        return io::is_complete(column, cells.num_cells());
                                      }),
                  "columns");
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  io::write_whole<io::RegionsToWrite>(io::region_writers, file, "regions are written as",
                                      {cells, columns, tolerance, execution});
}

}  // namespace rondel
