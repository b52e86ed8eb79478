// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points in spatial order while they come and go: a search tree of two levels. Points that follow
// each other on the Hilbert curve are close, so a neighbor in this order is where a walk should
// start.
#pragma once

#include <functional>
#include <vector>

#include "blocks/hilbert.h"
#include "rondel/types.h"

namespace rondel::blocks {

// Keys and values, sorted by key; the values of equal keys in no certain order.
//
//   leaves   |k v|k v|...|   |k v|...|   ...     at most `leaf_size` entries each
//   firsts    ^               ^                  the first key of each leaf
//
// Search is a binary search twice. A change moves the entries of one leaf; now and then one leaf is
// split in two or joined to its neighbor, which moves the list of leaves.
class SpatialIndex {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }

  void insert(const HilbertKey& key, Index value);

  // Precondition: the entry is there.
  void erase(const HilbertKey& key, Index value);

  // The first value with this key for which `is_wanted`, or no_index.
  [[nodiscard]] Index find(const HilbertKey& key,
                           const std::function<bool(Index)>& is_wanted) const;

  // The value of an entry next to the key in this order; no_index when there is none.
  [[nodiscard]] Index near(const HilbertKey& key) const;

  // All values in order.
  [[nodiscard]] std::vector<Index> values() const;

  // Replaces everything. `keys` are sorted.
  void assign(const std::vector<HilbertKey>& keys, const std::vector<Index>& values);

 private:
  static constexpr std::size_t leaf_size = 256;

  struct Leaf {
    std::vector<HilbertKey> keys;
    std::vector<Index> values;
  };

  // The last leaf whose first key is less than `key`, else the first one: entries with this key
  // start there, or at the begin of the next.
  [[nodiscard]] std::size_t leaf_of(const HilbertKey& key) const;
  void split(std::size_t i);
  void join_if_small(std::size_t i);

  std::vector<Leaf> leaves_;
  std::vector<HilbertKey> firsts_;
  std::size_t size_ = 0;
};

}  // namespace rondel::blocks
