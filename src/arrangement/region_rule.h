// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which parts of a subdivision belong to which regions of a set operation.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/coverage.h"
#include "rondel/set_operations.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A region that is asked for: a polygon of each operand, or no_index. For combine() both are 0.
struct RegionKey {
  Index first;
  Index second;
  friend auto operator<=>(const RegionKey&, const RegionKey&) = default;
};

// Which regions have a face, an edge or a node.
class RegionRule {
 public:
  RegionRule(SetOperation operation, bool is_joined)
      : is_joined_(is_joined),
        takes_both_(operation != SetOperation::difference &&
                    operation != SetOperation::symmetric_difference),
        takes_first_(operation != SetOperation::intersection),
        takes_second_(operation == SetOperation::unite ||
                      operation == SetOperation::symmetric_difference) {}

  // Appends the regions that have a part with these owners.
  void append_keys(const Owners& owners, std::vector<RegionKey>& keys) const {
    const auto& [first, second] = owners;
    if (!is_wanted(!first.empty(), !second.empty())) return;
    if (is_joined_) {
      keys.push_back({0, 0});
      return;
    }
    static const std::vector<Index> none = {no_index};
    for (const Index i : first.empty() ? none : first) {
      for (const Index k : second.empty() ? none : second) keys.push_back({i, k});
    }
  }
  [[nodiscard]] bool is_joined() const { return is_joined_; }
  // True if the face beyond an edge does not belong to the region, to which the face of the owners
  // belongs. `operands` has the operand of each polygon.
  [[nodiscard]] bool ends_at(const RegionKey& key, const Owners& owners,
                             std::span<const EdgeOfPolygon> edge,
                             const std::vector<std::uint8_t>& operands) const {
    // How many polygons of each operand have the face beyond, and whether those of the key do.
    std::array<std::size_t, 2> counts = {owners[0].size(), owners[1].size()};
    for (const EdgeOfPolygon& side : edge) {
      const std::uint8_t operand = operands[side.polygon];
      const bool is_left =
          std::ranges::find(owners[operand], side.polygon) != owners[operand].end();
      if (!is_joined_ && is_left && (side.polygon == key.first || side.polygon == key.second)) {
        return true;
      }
      counts[operand] += is_left ? static_cast<std::size_t>(-1) : 1;
    }
    if (is_joined_) return !is_wanted(counts[0] != 0, counts[1] != 0);
    return (key.first == no_index && counts[0] != 0) || (key.second == no_index && counts[1] != 0);
  }

 private:
  [[nodiscard]] bool is_wanted(bool is_in_first, bool is_in_second) const {
    if (is_in_first && is_in_second) return takes_both_;
    return (is_in_first && takes_first_) || (is_in_second && takes_second_);
  }

  bool is_joined_;
  bool takes_both_;
  bool takes_first_;
  bool takes_second_;
};

}  // namespace rondel::arrangement
