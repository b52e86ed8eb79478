// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements CreepLevels, by fronts of targets that have got a value last.
#include "interpolation/creep_levels.h"

#include <array>
#include <cstdint>
#include <utility>

namespace rondel::interpolation {

CreepLevels::CreepLevels(const CompressedRows<Index>& neighbors, const std::vector<bool>& has_value,
                         std::vector<bool>&& may_fill, Index most)
    : level_(has_value.size(), no_index) {
  std::vector<Index> front;
  for (std::size_t t = 0; t < has_value.size(); ++t) {
    if (!has_value[t]) continue;
    level_[t] = 0;
    front.push_back(static_cast<Index>(t));
  }
  for (Index level = 1; !front.empty() && (most == 0 || level <= most); ++level) {
    std::vector<Index> filled;
    for (const Index giver : front) {
      for (const Index target : neighbors[giver]) {
        const bool is_mutual = std::ranges::count(neighbors[target], giver) != 0;
        if (!is_mutual || !may_fill[target]) continue;
        may_fill[target] = false;
        filled.push_back(target);
      }
    }
    std::ranges::sort(filled);
    for (const Index target : filled) level_[target] = level;
    front = filled;
    if (!filled.empty()) filled_.push_back(std::move(filled));
  }
}

Weights CreepLevels::rows(const CompressedRows<Index>& neighbors, const Weights& weights,
                          std::span<const Point> sources) const {
  using Entries = std::vector<std::pair<Index, double>>;
  std::vector<Entries> made(level_.size());
  const auto row_of = [&](Index target) {
    if (level_[target] != 0) return made[target];
    Entries row;
    for (std::uint64_t k = weights.offsets[target]; k < weights.offsets[target + 1]; ++k) {
      row.emplace_back(weights.columns[k], weights.values[k]);
    }
    return row;
  };
  const auto is_before = [&](Index a, Index b) {
    const std::array at_a = {sources[a].x, sources[a].y, sources[a].z};
    const std::array at_b = {sources[b].x, sources[b].y, sources[b].z};
    return at_a != at_b ? at_a < at_b : a < b;
  };
  for (const std::vector<Index>& level : filled_) {
    for (const Index target : level) {
      Entries sum;
      double number = 0;
      for_each_giver(neighbors, target, [&](Index giver) {
        const Entries row = row_of(giver);
        sum.insert(sum.end(), row.begin(), row.end());
        ++number;
      });
      std::ranges::stable_sort(sum, is_before, &Entries::value_type::first);
      Entries& joined = made[target];
      for (const auto& [column, weight] : sum) {
        if (joined.empty() || joined.back().first != column) joined.emplace_back(column, 0);
        joined.back().second += weight / number;
      }
    }
  }
  Weights rows;
  rows.num_columns = weights.num_columns;
  for (const Entries& row : made) {
    for (const auto& [column, weight] : row) {
      rows.columns.push_back(column);
      rows.values.push_back(weight);
    }
    rows.end_row();
  }
  return rows;
}

}  // namespace rondel::interpolation
