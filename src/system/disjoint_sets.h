// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A union-find forest of indices, of which some are joined. A set is named by its lowest index.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "rondel/types.h"

namespace rondel::system {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), Index{0});
  }
  // Returns the lowest index of the set, and shortens the path to it.
  Index operator[](Index i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  // Returns the lowest index of the set, and changes nothing.
  Index operator[](Index i) const {
    while (parents_[i] != i) i = parents_[i];
    return i;
  }
  // Joins the sets of two indices, and returns whether they were different.
  bool join(Index i, Index k) {
    const auto [low, high] = std::minmax({(*this)[i], (*this)[k]});
    parents_[high] = low;
    return low != high;
  }

 private:
  std::vector<Index> parents_;
};

}  // namespace rondel::system
