// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points in spatial order while they come and go: a search tree of two levels. Points that follow
// each other on the Hilbert curve are close, so a neighbor in this order is where a walk should
// start.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "blocks/hilbert.h"
#include "rondel/types.h"

namespace rondel::blocks {

// Keys and values, sorted by key.
//
//   leaves   |k v|k v|...|   |k v|...|   ...     at most `leaf_size` entries each
//   firsts    ^               ^                  the first key of each leaf
//
// Search is a binary search twice. A change moves the entries of one leaf; now and then one leaf is
// split in two or joined to its neighbor, which moves the list of leaves.
//
// Entries of equal keys can be ordered by what their values stand for: `is_before(value)` tells
// whether an entry comes before the one that is meant. Where it is always false they are in no
// order, and searched one by one.
class SpatialIndex {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }

  template <class IsBefore>
  void insert(const HilbertKey& key, Index value, IsBefore is_before);

  // Precondition: the entry is there.
  template <class IsBefore>
  void erase(const HilbertKey& key, Index value, IsBefore is_before);

  // The first value with this key, not before the one that is meant, for which `is_wanted`;
  // no_index if there is none.
  template <class IsBefore, class IsWanted>
  [[nodiscard]] Index find(const HilbertKey& key, IsBefore is_before, IsWanted is_wanted) const;

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

  struct Position {
    std::size_t leaf = 0;
    std::size_t entry = 0;
  };

  // The first entry that is not before, perhaps the end of its leaf. Precondition: not empty.
  template <class IsBefore>
  [[nodiscard]] Position lower_bound(const HilbertKey& key, IsBefore is_before) const;

  // The first i in [0, size) for which is_before(i) is false, given that it is true before that.
  template <class IsBefore>
  static std::size_t partition_point(std::size_t size, IsBefore is_before);

  void insert_at(const Position& at, const HilbertKey& key, Index value);
  void erase_at(const Position& at);
  void split(std::size_t i);
  void join_if_small(std::size_t i);

  std::vector<Leaf> leaves_;
  std::vector<HilbertKey> firsts_;
  std::size_t size_ = 0;
};

template <class IsBefore>
std::size_t SpatialIndex::partition_point(std::size_t size, IsBefore is_before) {
  std::size_t first = 0;
  while (size > 0) {
    const std::size_t half = size / 2;
    if (is_before(first + half)) {
      first += half + 1;
      size -= half + 1;
    } else {
      size = half;
    }
  }
  return first;
}

template <class IsBefore>
SpatialIndex::Position SpatialIndex::lower_bound(const HilbertKey& key, IsBefore is_before) const {
  const std::size_t next = partition_point(firsts_.size(), [&](std::size_t i) {
    if (firsts_[i] != key) return firsts_[i] < key;
    return is_before(leaves_[i].values.front());
  });
  const std::size_t i = next == 0 ? 0 : next - 1;
  const Leaf& leaf = leaves_[i];
  return {i, partition_point(leaf.keys.size(), [&](std::size_t k) {
            if (leaf.keys[k] != key) return leaf.keys[k] < key;
            return is_before(leaf.values[k]);
          })};
}

template <class IsBefore>
void SpatialIndex::insert(const HilbertKey& key, Index value, IsBefore is_before) {
  insert_at(leaves_.empty() ? Position{} : lower_bound(key, is_before), key, value);
}

template <class IsBefore, class IsWanted>
Index SpatialIndex::find(const HilbertKey& key, IsBefore is_before, IsWanted is_wanted) const {
  if (leaves_.empty()) return no_index;
  for (auto [i, k] = lower_bound(key, is_before);; ++k) {
    if (k == leaves_[i].keys.size()) {
      if (++i == leaves_.size()) return no_index;
      k = 0;
    }
    if (leaves_[i].keys[k] != key) return no_index;
    if (is_wanted(leaves_[i].values[k])) return leaves_[i].values[k];
  }
}

template <class IsBefore>
void SpatialIndex::erase(const HilbertKey& key, Index value, IsBefore is_before) {
  Position at = lower_bound(key, is_before);
  for (;;) {
    if (at.entry == leaves_[at.leaf].keys.size()) {
      at = {at.leaf + 1, 0};
      assert(at.leaf < leaves_.size());
    } else if (leaves_[at.leaf].values[at.entry] == value) {
      break;
    } else {
      ++at.entry;
    }
  }
  assert(leaves_[at.leaf].keys[at.entry] == key);
  erase_at(at);
}

}  // namespace rondel::blocks
