// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws cells of any form as polygons in longitude and latitude.
//
// Cells are drawn in parallel: nearby points become one, each ring gets the corners that its
// neighbors have on it, and the loops become polygons that do not overlap.
#include "formats/region_drawing.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/cell_formats.h"
#include "io/flat_arrays.h"
#include "map/arc.h"
#include "map/common_corners.h"
#include "map/merged_points.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "overlay/single_cells.h"
#include "system/job.h"
#include "system/message_text.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::formats {
namespace {

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
map::LoopsOfRegion loops_of_cell(const RegionsToDraw& job, std::size_t cell,
                                 std::span<const map::UnitVectors> rings) {
  map::DrawnRegion region = map::draw_region(rings, job.tolerance);
  if (region.border != map::BorderKnowledge::is_known &&
      area_of(RingsOfCell(job.cells, cell).rings()) > 2 * std::numbers::pi)
    region.loops.push_back(map::border_loop());
  return std::move(region.loops);
}

// Returns the polygons of each cell, in degrees, of cells that do not overlap.
std::vector<map::PolygonsOfRegion> draw_together(const RegionsToDraw& job) {
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

}  // namespace

std::vector<map::PolygonsOfRegion> drawn_regions(const RegionsToDraw& job) {
  if (job.drawing == CellDrawing::together) return draw_together(job);
  std::vector<map::PolygonsOfRegion> drawn(job.cells.num_cells());
  const Execution alone{.threads = 1, .stop = job.execution.stop};
  system::parallel_for(
      job.execution.threads, drawn.size(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const CellRings single = overlay::one_cell(job.cells, static_cast<Index>(i));
          drawn[i] = std::move(draw_together({single, job.tolerance, alone}).front());
        }
      });
  return drawn;
}

// Throws InvalidInput if the arrays of the rings do not fit together.
void require_rings(const CellRings& cells) {
  io::require_fit(
      !cells.rings.empty() && system::are_offsets(cells.cells, cells.rings.size() - 1) &&
          system::are_offsets(cells.rings, cells.corners.size()) &&
          std::ranges::all_of(cells.corners, [&](Index p) { return p < cells.points.size(); }) &&
          io::are_unit_vectors(cells.points),
      "cells");
}

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
  const std::vector<map::PolygonsOfRegion> drawn =
      formats::drawn_regions({cells, tolerance, execution, drawing});
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

}  // namespace rondel
