// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/spatial_index.h"

#include <algorithm>

#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::order {

void SpatialIndex::Node::set(unsigned i, const HilbertKey& key, Index value) {
  highs[i] = key.high;
  lows[i] = key.low;
  values[i] = value;
}

void SpatialIndex::Node::insert(unsigned i, const HilbertKey& key, Index value) {
  std::copy_backward(&highs[i], &highs[size], &highs[size] + 1);
  std::copy_backward(&lows[i], &lows[size], &lows[size] + 1);
  std::copy_backward(&values[i], &values[size], &values[size] + 1);
  ++size;
  set(i, key, value);
}

void SpatialIndex::Node::move_tail(unsigned first, Node& to) {
  const unsigned count = size - first;
  std::copy_n(&highs[first], count, &to.highs[to.size]);
  std::copy_n(&lows[first], count, &to.lows[to.size]);
  std::copy_n(&values[first], count, &to.values[to.size]);
  to.size += count;
  size = first;
}

void SpatialIndex::Node::erase(unsigned i) {
  std::copy(highs.data() + i + 1, highs.data() + size, highs.data() + i);
  std::copy(lows.data() + i + 1, lows.data() + size, lows.data() + i);
  std::copy(values.data() + i + 1, values.data() + size, values.data() + i);
  --size;
}

// Without branches that depend on the keys: they would be mispredicted half of the time.
unsigned SpatialIndex::count_below(const Node& node, std::uint64_t high) {
  const std::uint64_t* first = node.highs.data();
  unsigned size = node.size;
  while (size > 1) {
    const unsigned half = size / 2;
    first += first[half - 1] < high ? half : 0;
    size -= half;
  }
  const auto before = static_cast<unsigned>(first - node.highs.data());
  return before + static_cast<unsigned>(size == 1 && *first < high);
}

void SpatialIndex::prefetch(const Node& node) {
  constexpr std::size_t line = 64;
  const auto* const bytes = reinterpret_cast<const char*>(&node);
  for (std::size_t i = 0; i < offsetof(Node, lows); i += line) system::prefetch(bytes + i);
}

void SpatialIndex::prefetch(const HilbertKey& key) const {
  static_cast<void>(seek(key, [](Index) { return false; }));
}

Index SpatialIndex::first_value(const Node& node, unsigned i, unsigned height) const {
  Index value = node.values[i];
  for (; height > 0; --height) value = nodes_[value].values[0];
  return value;
}

bool SpatialIndex::skip_end(Position& at) const {
  unsigned height = 0;
  while (height < depth_ && at.path_[height].entry == nodes_[at.path_[height].node].size) {
    if (++height < depth_) ++at.path_[height].entry;
  }
  if (height == depth_) return false;
  for (; height > 0; --height) {
    const Position::PathNode& above = at.path_[height];
    at.path_[height - 1] = {nodes_[above.node].values[above.entry], 0};
  }
  return true;
}

Index SpatialIndex::near(const Position& at, const HilbertKey& key) const {
  if (size_ == 0) return no_index;
  const Node& leaf = nodes_[at.path_[0].node];
  const unsigned after = at.path_[0].entry;
  if (after == 0) return leaf.values[0];
  const unsigned before = after - 1;
  const bool is_before =
      after == leaf.size || key.high - leaf.highs[before] < leaf.highs[after] - key.high;
  return leaf.values[is_before ? before : after];
}

std::array<Index, SpatialIndex::num_around> SpatialIndex::around(const Position& at) const {
  std::array<Index, num_around> result;
  result.fill(no_index);
  if (size_ == 0) return result;
  const Node& leaf = nodes_[at.path_[0].node];
  const unsigned entry = at.path_[0].entry;
  const unsigned first = entry > num_around / 2 ? entry - num_around / 2 : 0;
  const unsigned last = std::min(first + num_around, leaf.size);
  std::copy(leaf.values.data() + first, leaf.values.data() + last, result.data());
  return result;
}

Index SpatialIndex::near(const HilbertKey& key) const {
  return near(seek(key, [](Index) { return false; }), key);
}

void SpatialIndex::insert(Position at, const HilbertKey& key, Index value) {
  if (depth_ == 0) {
    root_ = new_node();
    depth_ = 1;
    at.path_[0] = {root_, 0};
  }
  insert_at(at, 0, key, value);
  ++size_;
}

void SpatialIndex::insert_at(Position& at, unsigned height, const HilbertKey& key, Index value) {
  if (nodes_[at.path_[height].node].size == node_size) split(at, height);
  const auto [node, entry] = at.path_[height];
  nodes_[node].insert(entry, key, value);
  if (entry == 0) update_parents(at, height);
}

// Moves the upper half to a new node behind. An entry in the middle comes to the end of the lower
// half: so none but the very first of all becomes the first of its node.
void SpatialIndex::split(Position& at, unsigned height) {
  const Index lower = at.path_[height].node;
  if (height + 1 == depth_) {
    root_ = new_node();
    nodes_[root_].insert(0, nodes_[lower].key(0), lower);
    at.path_[depth_++] = {root_, 0};
  }
  const Index upper = new_node();
  constexpr unsigned half = node_size / 2;
  nodes_[lower].move_tail(half, nodes_[upper]);
  ++at.path_[height + 1].entry;
  insert_at(at, height + 1, nodes_[upper].key(0), upper);
  if (at.path_[height].entry > half) {
    at.path_[height] = {upper, at.path_[height].entry - half};
  } else {
    --at.path_[height + 1].entry;
  }
}

void SpatialIndex::erase_at(Position& at, unsigned height) {
  const auto [index, entry] = at.path_[height];
  Node& node = nodes_[index];
  node.erase(entry);
  if (height + 1 == depth_) {
    lower_root();
  } else if (node.size == 0) {
    free_nodes_.push_back(index);
    erase_at(at, height + 1);
  } else {
    if (entry == 0) update_parents(at, height);
    if (node.size < node_size / 4) join(at, height);
  }
}

// With a neighbor below the same parent, if there is room.
void SpatialIndex::join(Position& at, unsigned height) {
  const Node& parent = nodes_[at.path_[height + 1].node];
  unsigned& entry = at.path_[height + 1].entry;
  constexpr unsigned most = node_size * 3 / 4;
  const auto is_small = [&](unsigned i) {
    return nodes_[parent.values[i]].size + nodes_[parent.values[i + 1]].size <= most;
  };
  if (entry + 1 < parent.size && is_small(entry)) {
    ++entry;
  } else if (entry == 0 || !is_small(entry - 1)) {
    return;
  }
  const Index upper = parent.values[entry];
  nodes_[upper].move_tail(0, nodes_[parent.values[entry - 1]]);
  free_nodes_.push_back(upper);
  erase_at(at, height + 1);
}

void SpatialIndex::lower_root() {
  while (depth_ > 0 && nodes_[root_].size < 2) {
    if (depth_ == 1 && nodes_[root_].size == 1) return;
    free_nodes_.push_back(root_);
    root_ = --depth_ == 0 ? no_index : nodes_[root_].values[0];
  }
}

// After a change of the first key of a node.
void SpatialIndex::update_parents(const Position& at, unsigned height) {
  const HilbertKey key = nodes_[at.path_[height].node].key(0);
  while (++height < depth_) {
    const auto [node, entry] = at.path_[height];
    nodes_[node].highs[entry] = key.high;
    nodes_[node].lows[entry] = key.low;
    if (entry > 0) break;
  }
}

Index SpatialIndex::new_node() {
  if (free_nodes_.empty()) {
    system::grow_large(nodes_);
    nodes_.emplace_back();
    return static_cast<Index>(nodes_.size() - 1);
  }
  const Index node = free_nodes_.back();
  free_nodes_.pop_back();
  nodes_[node].size = 0;
  return node;
}

std::vector<Index> SpatialIndex::leaves() const {
  std::vector<Index> nodes;
  if (depth_ > 0) nodes.push_back(root_);
  for (unsigned height = depth_; height > 1; --height) {
    std::vector<Index> children;
    for (const Index node : nodes) {
      const auto* const first = nodes_[node].values.data();
      children.insert(children.end(), first, first + nodes_[node].size);
    }
    nodes = std::move(children);
  }
  return nodes;
}

std::vector<Index> SpatialIndex::values() const {
  std::vector<Index> result;
  result.reserve(size_);
  for (const Index leaf : leaves()) {
    const auto* const first = nodes_[leaf].values.data();
    result.insert(result.end(), first, first + nodes_[leaf].size);
  }
  return result;
}

void SpatialIndex::renumber() {
  Index next = 0;
  for (const Index leaf : leaves()) {
    for (unsigned i = 0; i < nodes_[leaf].size; ++i) nodes_[leaf].values[i] = next++;
  }
}

void SpatialIndex::assign(const std::vector<HilbertKey>& keys, const std::vector<Index>& values) {
  *this = {};
  size_ = keys.size();
  constexpr std::size_t fill = node_size * 3 / 4;  // room for the next changes
  std::size_t num_nodes = 0;
  for (std::size_t level = keys.size(); level > 1; num_nodes += level) {
    level = level / fill + (level % fill != 0 ? 1 : 0);
  }
  system::reserve_large(nodes_, num_nodes);
  std::vector<Index> below;
  for (std::size_t begin = 0; begin < keys.size(); begin += fill) {
    Node& leaf = nodes_[below.emplace_back(new_node())];
    const std::size_t end = std::min(begin + fill, keys.size());
    for (std::size_t i = begin; i < end; ++i) leaf.set(leaf.size++, keys[i], values[i]);
  }
  if (below.empty()) return;
  for (depth_ = 1; below.size() > 1; ++depth_) {
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (i % fill == 0) nodes.push_back(new_node());
      Node& node = nodes_[nodes.back()];
      node.set(node.size++, nodes_[below[i]].key(0), below[i]);
    }
    below = std::move(nodes);
  }
  root_ = below.front();
}

}  // namespace rondel::order
