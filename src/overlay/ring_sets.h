// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers sets of rings, for a sweep over them.
//
// index rings, as given; sets: the set of ring r alone has the number r, the empty set the number
//       after these
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "rondel/types.h"

namespace rondel::overlay {

class RingSets {
 public:
  explicit RingSets(std::size_t num_rings) : rings_(num_rings), more_(1), numbers_{{{}, empty()}} {
    std::iota(rings_.begin(), rings_.end(), Index{0});
  }

  [[nodiscard]] Index empty() const { return static_cast<Index>(rings_.size()); }
  [[nodiscard]] std::size_t size() const { return rings_.size() + more_.size(); }
  // Returns the rings of a set, ascending. The span is valid until another set gets a number.
  [[nodiscard]] std::span<const Index> operator[](Index set) const {
    if (set < rings_.size()) return std::span(rings_).subspan(set, 1);
    return more_[set - rings_.size()];
  }

  // Returns the set of the rings that are in one of two sets alone. Most sets are empty or one ring.
  Index symmetric_difference(Index first, Index second) {
    if (first == empty()) return second;
    if (second == empty()) return first;
    if (first == second) return empty();
    std::vector<Index> rings;
    std::ranges::set_symmetric_difference((*this)[first], (*this)[second],
                                          std::back_inserter(rings));
    if (rings.size() == 1) return rings.front();
    const auto [known, is_new] = numbers_.try_emplace(rings, static_cast<Index>(size()));
    if (is_new) more_.push_back(std::move(rings));
    return known->second;
  }

 private:
  std::vector<Index> rings_;                     // all of them, ascending
  std::vector<std::vector<Index>> more_;         // the sets that are no ring
  std::map<std::vector<Index>, Index> numbers_;  // theirs
};

}  // namespace rondel::overlay
