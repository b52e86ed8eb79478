// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Replaces cells that are not valid polygons in the plane: item 5 of CellMap.
#include <atomic>
#include <cstddef>
#include <vector>

#include "map/cell_map.h"
#include "map/line_troubles.h"
#include "map/settled_regions.h"
#include "system/parallel.h"

namespace rondel::map {
namespace {

constexpr std::size_t cells_per_task = 1024;

}  // namespace

bool CellMap::has_invalid(const Execution& execution) const {
  if (only_vertex_ < sites_.size()) return false;
  std::atomic<bool> found{false};
  system::parallel_for(
      execution.threads, sites_.size(), cells_per_task, [&](std::size_t begin, std::size_t end) {
        Pen pen;
        for (std::size_t site = begin; site < end && !found; ++site) {
          if (has_cell(site) && !is_unchanged(site) && is_in_trouble(loops_of(site, pen)))
            found = true;
        }
      });
  return found;
}

std::vector<Loop> CellMap::loops_of(std::size_t site, Pen& pen) const {
  std::vector<Loop> loops;
  if (is_unchanged(site)) {
    loops.emplace_back();
    for (const Index point : points_of(site)) loops.back().push_back(positions_[point]);
  } else if (draw_ring(site, pen.ring_, pen.trace_)) {
    loops = drawn_loops(pen.trace_);
  }
  return loops;
}

void CellMap::settle(const Execution& execution) {
  std::vector<std::vector<DirectedLine>> sides(sites_.size());
  system::parallel_for(execution.threads, sites_.size(), cells_per_task,
                       [&](std::size_t begin, std::size_t end) {
                         Pen pen;
                         for (std::size_t site = begin; site < end; ++site) {
                           if (has_cell(site)) sides[site] = sides_of_loops(loops_of(site, pen));
                         }
                       });
  settled_ = settled_convex_regions(sides, execution.threads);
}

}  // namespace rondel::map
