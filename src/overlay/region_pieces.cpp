// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "system/job.h"

namespace rondel {
namespace {

using GroupPair = std::pair<Index, Index>;

// Returns the group of a cell. Throws InvalidInput if it has none.
Index group_of_piece(std::span<const Index> groups, Index number, const char* what) {
  if (groups.empty()) return number;
  if (number < groups.size()) return groups[number];
  throw InvalidInput("there are " + std::to_string(groups.size()) + " groups of " + what + " for " +
                         what + ' ' + std::to_string(number),
                     number);
}

}  // namespace

RegionPieces dissolve(const RegionPieces& pieces, std::span<const Index> cell_groups,
                      std::span<const Index> region_groups, const Execution& execution) {
  const system::Call call(execution);
  std::vector<GroupPair> of_pieces;
  of_pieces.reserve(pieces.num_pieces());
  for (std::size_t k = 0; k < pieces.num_pieces(); ++k) {
    of_pieces.emplace_back(group_of_piece(cell_groups, pieces.cells[k], "cells"),
                           group_of_piece(region_groups, pieces.regions[k], "regions"));
  }
  const auto is_left_out = [](const GroupPair& pair) {
    return pair.first == no_index || pair.second == no_index;
  };
  std::vector<GroupPair> pairs = of_pieces;
  std::erase_if(pairs, is_left_out);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Index> groups;
  groups.reserve(of_pieces.size());
  for (const GroupPair& pair : of_pieces) {
    const auto number = std::ranges::lower_bound(pairs, pair) - pairs.begin();
    groups.push_back(is_left_out(pair) ? no_index : static_cast<Index>(number));
  }
  RegionPieces joined;
  joined.rings = dissolve(pieces.rings, groups, pairs.size(), execution);
  for (const auto& [cell, region] : pairs) {
    joined.cells.push_back(cell);
    joined.regions.push_back(region);
  }
  return joined;
}

}  // namespace rondel
