// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <string>
#include <vector>

#include "overlay/disjoint_cells.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "rondel/error.h"
#include "rondel/set_operations.h"
#include "system/disjoint_sets.h"

namespace rondel::overlay {

std::optional<CellSet> united(const CellSetData& cells, const char* what,
                              const Execution& execution) {
  const std::vector<CrossingCells>& overlaps = cells.overlaps(execution);
  if (overlaps.empty()) return std::nullopt;
  const std::size_t size = cells.areas().size();
  system::DisjointSets sets(size);
  for (const CrossingCells& pair : overlaps) {
    if (pair.first == pair.second) {
      throw InvalidInput(std::string(what) + ' ' + message_of(pair), pair.second);
    }
    sets.join(pair.first, pair.second);
  }
  const CellRings all = rings_of(cells);
  // The cells of each set, of which the first one becomes the union.
  std::vector<CellRings> together(size);
  for (Index i = 0; i < size; ++i) append(one_cell(all, i), together[sets[i]]);
  const Execution quiet{.threads = execution.threads, .stop = execution.stop};
  CellRings result;
  for (const CellRings& some : together) {
    if (some.num_cells() == 0) {
      result.end_cell();
    } else {
      append(some.num_cells() > 1 ? unite(some, quiet) : some, result);
    }
  }
  merge_equal_points(result);
  return CellSet::polygons(result, quiet);
}

}  // namespace rondel::overlay
