// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "arrangement/prepared_lines.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rondel::arrangement {

PreparedLines::PreparedLines(const FeatureLines& lines, std::size_t feature,
                             std::span<const Point> points, std::span<const Index> numbers)
    : PreparedSides(points) {
  std::vector<Index> ends;
  for (std::uint64_t i = lines.offsets[feature]; i < lines.offsets[feature + 1]; ++i) {
    const std::span<const Index> nodes =
        numbers.subspan(lines.rows.offsets[i], lines.rows[i].size());
    ends.push_back(nodes.front());
    ends.push_back(nodes.back());
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      if (nodes[k - 1] != nodes[k]) sides_.push_back({nodes[k - 1], nodes[k]});
    }
  }
  make_boxes();
  divide_sides(false);
  // An arc that occurs twice stays once.
  std::vector<std::tuple<Index, Index, Index>> places;
  places.reserve(sides_.size());
  for (Index s = 0; s < sides_.size(); ++s) {
    const auto [low, high] = std::minmax({sides_[s].from, sides_[s].to});
    places.emplace_back(low, high, s);
  }
  std::ranges::sort(places);
  std::vector<Index> kept;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto [low, high, s] = places[k];
    const bool is_first =
        k == 0 || std::get<0>(places[k - 1]) != low || std::get<1>(places[k - 1]) != high;
    if (is_first) kept.push_back(s);
  }
  std::ranges::sort(kept);
  keep_sides(kept);
  const std::vector<NodeOfSide> at_nodes = sorted_ends();
  system::DisjointSets sets(sides_.size());
  for (std::size_t k = 1; k < at_nodes.size(); ++k) {
    if (at_nodes[k - 1].node == at_nodes[k].node) sets.join(at_nodes[k - 1].side, at_nodes[k].side);
  }
  make_components(sets);
  for (Index c = 0; c < num_components(); ++c) extent_.include(component_boxes().box(c));
  std::ranges::sort(ends);
  for (std::size_t begin = 0; begin < ends.size();) {
    std::size_t end = begin;
    while (end < ends.size() && ends[end] == ends[begin]) ++end;
    if ((end - begin) % 2 != 0) boundary_.push_back(ends[begin]);
    begin = end;
  }
}

bool PreparedLines::has_boundary(Index node) const {
  return std::ranges::binary_search(boundary_, node);
}

}  // namespace rondel::arrangement
