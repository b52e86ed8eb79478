// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes cells of any form as GeoJSON (RFC 7946) and returns their polygons: write_regions() and
// region_polygons(). The file is a FeatureCollection with a feature for each cell that has rings.
//
// Cells are drawn in parallel: nearby points become one, each ring gets the corners that its
// neighbors have on it, and the loops become polygons that do not overlap.
#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/regions_gdal.h"
#include "io/cell_formats.h"
#include "io/ending.h"
#include "io/flat_arrays.h"
#include "io/geojson_writer.h"
#include "io/number.h"
#include "map/arc.h"
#include "map/common_corners.h"
#include "map/merged_points.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "map/valid_regions.h"
#include "overlay/single_cells.h"
#include "rondel/regions.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

// The arguments of write_regions().
struct RegionsToWrite {
  const CellRings& cells;
  std::span<const Column> columns;
  double tolerance;  // radians
  const Execution& execution;
  const Column& ids;
  CellDrawing drawing = CellDrawing::together;
};

// The number of cells that a thread draws at once.
constexpr std::size_t cells_per_task = 16;

// Returns the corners of a ring, as indices of points.
std::span<const Index> ring_of(const CellRings& cells, std::uint64_t ring) {
  return std::span(cells.corners)
      .subspan(cells.rings[ring], cells.rings[ring + 1] - cells.rings[ring]);
}

// The points of the rings of a cell.
class RingsOfCell {
 public:
  // Takes the points of the corners as they are.
  RingsOfCell(const CellRings& cells, std::size_t cell)
      : RingsOfCell(cells, cell, [&](std::span<const Index> corners, std::vector<Point>& ring) {
          for (const Index corner : corners) ring.push_back(cells.points[corner]);
        }) {}

  // Calls append_ring(corners, ring), which appends the points of the corners.
  template <class AppendRing>
  RingsOfCell(const CellRings& cells, std::size_t cell, const AppendRing& append_ring) {
    for (std::uint64_t r = cells.cells[cell]; r < cells.cells[cell + 1]; ++r)
      append_ring(ring_of(cells, r), points_.emplace_back());
    rings_.assign(points_.begin(), points_.end());
  }
  // Returns the rings, which live as long as this object.
  [[nodiscard]] std::span<const map::UnitVectors> rings() const { return rings_; }

 private:
  std::vector<std::vector<Point>> points_;
  std::vector<map::UnitVectors> rings_;
};

// Returns the area to the left of the rings in steradians, from 0 to 4 pi.
double area_of(std::span<const map::UnitVectors> rings) {
  const double area = map::areas_on_left(rings);
  return area < 0 ? area + 4 * std::numbers::pi : area;
}

// Returns the lines around a cell. If they do not tell on which side of them the cell is, its area
// does, computed from the corners before points were merged.
map::LoopsOfRegion loops_of_cell(const RegionsToWrite& job, std::size_t cell,
                                 std::span<const map::UnitVectors> rings) {
  map::DrawnRegion region = map::draw_region(rings, job.tolerance);
  if (region.border != map::BorderKnowledge::is_known &&
      area_of(RingsOfCell(job.cells, cell).rings()) > 2 * std::numbers::pi)
    region.loops.push_back(map::border_loop());
  return std::move(region.loops);
}

// Returns the polygons of each cell, in degrees, of cells that do not overlap.
std::vector<map::PolygonsOfRegion> draw_together(const RegionsToWrite& job) {
  const std::vector<Point> points = map::merged_points(job.cells.points);
  const map::CommonCorners common(job.cells, points, job.execution.threads);
  const auto append_ring = [&](std::span<const Index> corners, std::vector<Point>& ring) {
    common.append_ring(corners, points, ring);
  };
  std::vector<map::LoopsOfRegion> loops(job.cells.num_cells());
  system::parallel_for(job.execution.threads, loops.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           const RingsOfCell cell(job.cells, i, append_ring);
                           if (cell.rings().empty() && !job.cells.is_whole(i)) continue;
                           loops[i] = loops_of_cell(job, i, cell.rings());
                         }
                       });
  return map::valid_regions(std::move(loops), job.execution.threads);
}

// Returns the polygons of each cell, in degrees.
std::vector<map::PolygonsOfRegion> draw(const RegionsToWrite& job) {
  if (job.drawing == CellDrawing::together) return draw_together(job);
  std::vector<map::PolygonsOfRegion> drawn(job.cells.num_cells());
  const Execution alone{.threads = 1, .stop = job.execution.stop};
  system::parallel_for(
      job.execution.threads, drawn.size(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const CellRings single = overlay::one_cell(job.cells, static_cast<Index>(i));
          drawn[i] = std::move(draw_together({single, {}, job.tolerance, alone, {}}).front());
        }
      });
  return drawn;
}

// True if the cell has rings or is the whole sphere.
bool has_feature(const CellRings& cells, std::size_t cell) {
  return cells.cells[cell] != cells.cells[cell + 1] || cells.is_whole(cell);
}

// Writes a feature for each cell: its id, its area in steradians, its columns and its polygons.
void write_regions_geojson(io::AtomicFile& file, const RegionsToWrite& job) {
  const std::vector<map::PolygonsOfRegion> drawn = draw(job);
  std::vector<std::string> geometries(drawn.size());
  system::parallel_for(job.execution.threads, drawn.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           if (!has_feature(job.cells, i)) continue;
                           io::append_geometry(geometries[i], drawn[i]);
                         }
                       });
  const std::vector<double> sizes = areas(job.cells);
  const std::vector<std::string> keys = io::property_keys(job.columns, {"area"});
  file.write(io::features_begin);
  bool is_first = true;
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    if (geometries[i].empty()) continue;
    std::string text;
    io::begin_feature(text, std::exchange(is_first, false), job.ids, i);
    text += R"("area":)";
    io::append_number(text, sizes[i]);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      text += keys[k];
      io::append_value(text, job.columns[k], i);
    }
    text += io::geometry_begin + geometries[i] + '}';
    file.write(text);
  }
  file.write(io::features_end);
}

// True if a column has a cell for each row, and its ends fit to its text.
bool is_complete(const Column& column, std::size_t num_rows) {
  return column.ends.size() == num_rows && std::ranges::is_sorted(column.ends) &&
         (column.ends.empty() || column.ends.back() == column.text.size());
}

// Returns the polygons of all cells in compressed rows.
LonLatRegions polygons_of(const RegionsToWrite& job) {
  const std::vector<map::PolygonsOfRegion> drawn = draw(job);
  LonLatRegions all;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (const map::PolygonWithHoles& polygon : drawn[i]) {
      for (const std::vector<LonLat>& ring : polygon.rings) {
        all.polygons.rows.append(ring);
      }
      all.polygons.end_group();
      all.owners.push_back(static_cast<Index>(i));
    }
  }
  return all;
}

// GDAL writes the formats that are not here (regions_gdal.cpp).
constexpr std::array<io::Writer<RegionsToWrite>, 1> region_writers = {
    {{".geojson", &write_regions_geojson}}};

// Throws InvalidInput if the arrays of the rings do not fit together.
void require_rings(const CellRings& cells) {
  io::require_fit(
      !cells.rings.empty() && system::are_offsets(cells.cells, cells.rings.size() - 1) &&
          system::are_offsets(cells.rings, cells.corners.size()) &&
          std::ranges::all_of(cells.corners, [&](Index p) { return p < cells.points.size(); }) &&
          io::are_unit_vectors(cells.points),
      "cells");
}

}  // namespace
}  // namespace rondel::formats

namespace rondel {

std::string_view name_of(CellDrawing drawing) noexcept {
  return system::name_in({"together", "apart"}, drawing);
}

LonLatRegions region_polygons(const CellRings& cells, double tolerance_deg,
                              const Execution& execution, CellDrawing drawing) {
  const system::Call call(execution);
  formats::require_rings(cells);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  return formats::polygons_of({cells, {}, tolerance, execution, {}, drawing});
}

LonLatMultiPolygons multipolygons(LonLatRegions regions, std::size_t num_cells) {
  io::require_fit(regions.owners.size() == regions.polygons.size() &&
                      std::ranges::is_sorted(regions.owners) &&
                      (regions.owners.empty() || regions.owners.back() < num_cells),
                  "owners");
  LonLatMultiPolygons features;
  features.offsets = system::offsets_of(num_cells, [&](std::size_t cell) {
    const auto [begin, end] = std::equal_range(regions.owners.begin(), regions.owners.end(), cell);
    return static_cast<std::uint64_t>(end - begin);
  });
  features.rows = std::move(regions.polygons);
  return features;
}

bool can_write_regions(const FileName& file) {
  return io::ending(file) == formats::region_writers.front().ending ||
         formats::is_format_of_gdal(file);
}

void write_regions(const FileName& file, const CellRings& cells, std::span<const Column> columns,
                   double tolerance_deg, const Execution& execution, const Column& ids,
                   CellDrawing drawing) {
  const system::Call call(execution);
  formats::require_rings(cells);
  io::require_fit(ids.ends.empty() || formats::is_complete(ids, cells.num_cells()), "ids");
  io::require_fit(std::ranges::all_of(columns,
                                      [&](const Column& column) {
                                        return formats::is_complete(column, cells.num_cells());
                                      }),
                  "columns");
  require_region_writer(file);
  const double tolerance = io::checked_tolerance(tolerance_deg) / map::degrees_per_radian;
  const formats::RegionsToWrite job{cells, columns, tolerance, execution, ids, drawing};
  if (formats::is_format_of_gdal(file)) {
    formats::write_regions_gdal(file, formats::polygons_of(job), areas(cells), columns);
  } else {
    io::write_whole<formats::RegionsToWrite>(formats::region_writers, file,
                                             "regions are written as", job);
  }
}

}  // namespace rondel
