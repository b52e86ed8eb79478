// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells that are no polygons in the plane: CellMap's item 5.
#include <cstddef>
#include <vector>

#include "map/cell_map.h"
#include "map/line_troubles.h"
#include "system/parallel.h"

namespace rondel::map {

void CellMap::leave_out_invalid(const Execution& execution) {
  constexpr std::size_t grain = 1024;
  if (only_vertex_ < sites_.size()) return;
  const SharedLines unchanged;
  std::vector<std::vector<std::size_t>> found(system::num_pieces(sites_.size(), grain));
  system::parallel_for(execution.threads, sites_.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         Pen pen;
                         for (std::size_t site = begin; site < end; ++site) {
                           if (!has_cell(site) || (is_plain_[site] != 0 && !has_changed_arc(site)))
                             continue;
                           std::vector<Loop> loops;
                           for (const LonLatPolygon& polygon : polygons(site, pen))
                             loops.emplace_back(polygon.ring.begin(), polygon.ring.end() - 1);
                           if (!look_at_region(loops, unchanged).troubles.empty())
                             found[begin / grain].push_back(site);
                         }
                       });
  for (const auto& sites : found) unresolved_.insert(sites.begin(), sites.end());
}

}  // namespace rondel::map
