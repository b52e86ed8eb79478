// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points in spatial order while they come and go: a B-tree along the Hilbert curve (Bayer and
// McCreight, Acta Informatica 1, 1972). Points that follow each other on the curve are close, so a
// neighbor in this order is where a walk should start.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "order/hilbert.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::order {

// Keys and values, sorted by key.
//
//               | k c | k c | ...          an inner node: for each child the first key below it
//                  /     |
//         |k v|k v|...  |k v|k v|...       the leaves, all at the same depth
//
// In a large set of random places a search misses the caches in the last node or two only, once
// each: what the search of a node may read is asked for at once.
//
// Entries of equal keys can be ordered by what their values stand for: `is_before(value)` tells
// whether an entry comes before the one that is meant. Where it is always false they are in no
// order, and searched one by one.
class SpatialIndex {
  static constexpr unsigned node_size = 64;
  // A new level takes at least 31 splits of the level below: 31^15 changes are never made.
  static constexpr unsigned max_depth = 16;

 public:
  // Where an entry is, or would be; until the next change.
  class Position {
    friend class SpatialIndex;
    struct PathNode {
      Index node = 0;
      unsigned entry = 0;
    };
    std::array<PathNode, max_depth> path_;  // by height: the leaf first
  };

  [[nodiscard]] std::size_t size() const { return size_; }

  // The first entry that is not before the one that is meant, or the end.
  template <class IsBefore>
  [[nodiscard]] Position seek(const HilbertKey& key, IsBefore is_before) const;

  // The first value with this key, from the position of the key on, for which `is_wanted`;
  // no_index if there is none.
  template <class IsWanted>
  [[nodiscard]] Index find(Position at, const HilbertKey& key, IsWanted is_wanted) const;

  // The value of the entry next to the position of the key, before or after it, that is closer on
  // the curve, as far as its leaf tells; no_index when there is none.
  [[nodiscard]] Index near(const Position& at, const HilbertKey& key) const;
  [[nodiscard]] Index near(const HilbertKey& key) const;

  // Asks for the memory that a search for the key reads last.
  RONDEL_API void prefetch(const HilbertKey& key) const;

  // Some values of entries around the position, for what only guesses what is close; the rest is
  // no_index.
  static constexpr unsigned num_around = 10;
  [[nodiscard]] std::array<Index, num_around> around(const Position& at) const;

  // `at` is the position of the key.
  void insert(Position at, const HilbertKey& key, Index value);

  // Precondition: the entry is there.
  template <class IsBefore>
  void erase(const HilbertKey& key, Index value, IsBefore is_before);

  // All values in order.
  [[nodiscard]] RONDEL_API std::vector<Index> values() const;

  // Replaces the values: 0, 1, 2 ... in order.
  void renumber();

  // Replaces everything. `keys` are sorted.
  void assign(const std::vector<HilbertKey>& keys, const std::vector<Index>& values);

 private:
  // Keys in two halves: the high ones rarely tie.
  struct Node {
    unsigned size = 0;
    std::array<std::uint64_t, node_size> highs;
    std::array<Index, node_size> values;  // of an inner node: the children
    std::array<std::uint64_t, node_size> lows;

    [[nodiscard]] HilbertKey key(unsigned i) const { return {highs[i], lows[i]}; }
    void set(unsigned i, const HilbertKey& key, Index value);
    void insert(unsigned i, const HilbertKey& key, Index value);
    void erase(unsigned i);
    // Moves the entries from `first` on to the end of another node.
    void move_tail(unsigned first, Node& to);
  };

  // The value of the first leaf entry below entry i of a node.
  [[nodiscard]] Index first_value(const Node& node, unsigned i, unsigned height) const;
  static void prefetch(const Node& node);
  // The first i in [first, last) for which is_before(i) is false, given that it is true before.
  template <class IsBefore>
  static unsigned partition_point(unsigned first, unsigned last, IsBefore is_before);
  // The number of entries whose high key is less.
  static unsigned count_below(const Node& node, std::uint64_t high);
  // From the end of a leaf to the next leaf. Returns whether there is an entry.
  bool skip_end(Position& at) const;

  // The leaves in order, by their numbers.
  [[nodiscard]] std::vector<Index> leaves() const;

  Index new_node();
  // `at` becomes the path to the new entry, or to the one behind that which was erased.
  void insert_at(Position& at, unsigned height, const HilbertKey& key, Index value);
  void erase_at(Position& at, unsigned height);
  void split(Position& at, unsigned height);
  void join(Position& at, unsigned height);
  void lower_root();
  void update_parents(const Position& at, unsigned height);

  std::vector<Node> nodes_;
  std::vector<Index> free_nodes_;
  Index root_ = no_index;
  unsigned depth_ = 0;  // the number of levels; leaves have height 0
  std::size_t size_ = 0;
};

template <class IsBefore>
unsigned SpatialIndex::partition_point(unsigned first, unsigned last, IsBefore is_before) {
  while (first < last) {
    const unsigned middle = first + (last - first) / 2;
    if (is_before(middle)) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

template <class IsBefore>
SpatialIndex::Position SpatialIndex::seek(const HilbertKey& key, IsBefore is_before) const {
  Position at;
  Index child = root_;
  for (unsigned height = depth_; height-- > 0;) {
    const Node& node = nodes_[child];
    unsigned i = count_below(node, key.high);
    if (i < node.size && node.highs[i] == key.high) {
      i = partition_point(i, node.size, [&](unsigned k) {
        if (node.key(k) != key) return node.key(k) < key;
        return is_before(first_value(node, k, height));
      });
    }
    if (height > 0 && i > 0) --i;
    at.path_[height] = {child, i};
    if (height == 0) break;
    child = node.values[i];
    prefetch(nodes_[child]);
  }
  return at;
}

template <class IsWanted>
Index SpatialIndex::find(Position at, const HilbertKey& key, IsWanted is_wanted) const {
  while (skip_end(at)) {
    Position::PathNode& step = at.path_[0];
    const Node& leaf = nodes_[step.node];
    if (leaf.key(step.entry) != key) break;
    if (is_wanted(leaf.values[step.entry])) return leaf.values[step.entry];
    ++step.entry;
  }
  return no_index;
}

template <class IsBefore>
void SpatialIndex::erase(const HilbertKey& key, Index value, IsBefore is_before) {
  Position at = seek(key, is_before);
  for (;;) {
    [[maybe_unused]] const bool is_entry = skip_end(at);
    assert(is_entry);
    Position::PathNode& step = at.path_[0];
    if (nodes_[step.node].values[step.entry] == value) break;
    ++step.entry;
  }
  erase_at(at, 0);
  --size_;
}

}  // namespace rondel::order
