// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "overlay/disjoint_cells.h"
#include "overlay/overlaps.h"
#include "overlay/single_cells.h"
#include "rondel/error.h"
#include "system/disjoint_sets.h"

namespace rondel::overlay {
namespace {

// Returns a cell and its complement as a partition of the sphere.
CellSet both_sides(const CellRings& one) {
  CellRings both = one;
  append(beyond_cell(one), both);
  return CellSet::polygons(both);
}

// Throws InvalidInput if the pieces of a cell, which are those with number 0, do not add up to it.
void require_pieces(const CellRings& cell, const CellRings& pieces,
                    const std::vector<Index>& numbers) {
  constexpr double rounding = 1e-9;
  const std::vector<double> sizes = areas(pieces);
  double sum = 0;
  for (std::size_t k = 0; k < sizes.size(); ++k) sum += numbers[k] == 0 ? sizes[k] : 0;
  const double area = areas(cell).front();
  if (std::abs(sum - area) <= rounding) return;
  throw InvalidInput("regions that overlap cannot be united: the parts of one add up to " +
                     std::to_string(sum) + " of " + std::to_string(area) + " steradians");
}

// Returns the union of two cells. All pieces come from one overlay, so that they have the same
// corners where they meet.
CellRings union_of(const CellRings& a, const CellRings& b, const Execution& execution) {
  const RegionPieces pieces = intersection(both_sides(a), both_sides(b), execution);
  require_pieces(a, pieces.rings, pieces.cells);
  require_pieces(b, pieces.rings, pieces.regions);
  std::vector<Index> groups;
  for (std::size_t k = 0; k < pieces.num_pieces(); ++k) {
    const bool is_in_any = pieces.cells[k] == 0 || pieces.regions[k] == 0;
    groups.push_back(is_in_any ? 0 : no_index);
  }
  return dissolve(pieces.rings, groups, 1, execution);
}

}  // namespace

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
  const Execution told{.threads = execution.threads, .stop = execution.stop};
  const CellRings all = rings_of(cells);
  std::vector<CellRings> unions;
  for (Index i = 0; i < size; ++i) {
    unions.push_back(one_cell(all, i));
    const Index first = sets[i];
    if (first == i) continue;
    unions[first] = union_of(unions[first], unions[i], told);
    unions[i] = one_cell({.cells = {0, 0}, .rings = {0}, .corners = {}, .points = {}}, 0);
  }
  CellRings result;
  for (const CellRings& one : unions) append(one, result);
  merge_equal_points(result);
  return CellSet::polygons(result, told);
}

}  // namespace rondel::overlay
