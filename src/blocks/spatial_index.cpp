// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/spatial_index.h"

#include <algorithm>
#include <cstddef>

namespace rondel::blocks {
namespace {

template <class Vector>
auto at(Vector& v, std::size_t i) {
  return v.begin() + static_cast<std::ptrdiff_t>(i);
}

}  // namespace

void SpatialIndex::insert_at(const Position& at_entry, const HilbertKey& key, Index value) {
  auto [i, k] = at_entry;
  if (leaves_.empty()) {
    leaves_.emplace_back();
    firsts_.push_back(key);
  }
  if (leaves_[i].keys.size() == leaf_size) {
    split(i);
    if (k > leaves_[i].keys.size()) k -= leaves_[i++].keys.size();
  }
  Leaf& leaf = leaves_[i];
  leaf.keys.insert(at(leaf.keys, k), key);
  leaf.values.insert(at(leaf.values, k), value);
  firsts_[i] = leaf.keys.front();
  ++size_;
}

void SpatialIndex::erase_at(const Position& at_entry) {
  Leaf& leaf = leaves_[at_entry.leaf];
  leaf.keys.erase(at(leaf.keys, at_entry.entry));
  leaf.values.erase(at(leaf.values, at_entry.entry));
  --size_;
  join_if_small(at_entry.leaf);
}

Index SpatialIndex::near(const HilbertKey& key) const {
  if (leaves_.empty()) return no_index;
  const auto [i, k] = lower_bound(key, [](Index) { return false; });
  return leaves_[i].values[std::min(k, leaves_[i].keys.size() - 1)];
}

std::vector<Index> SpatialIndex::values() const {
  std::vector<Index> result;
  result.reserve(size_);
  for (const Leaf& leaf : leaves_) {
    result.insert(result.end(), leaf.values.begin(), leaf.values.end());
  }
  return result;
}

void SpatialIndex::assign(const std::vector<HilbertKey>& keys, const std::vector<Index>& values) {
  leaves_.clear();
  firsts_.clear();
  size_ = keys.size();
  constexpr std::size_t fill = leaf_size * 3 / 4;  // room for the next changes
  for (std::size_t begin = 0; begin < keys.size(); begin += fill) {
    const std::size_t end = std::min(begin + fill, keys.size());
    Leaf& leaf = leaves_.emplace_back();
    leaf.keys.assign(at(keys, begin), at(keys, end));
    leaf.values.assign(at(values, begin), at(values, end));
    firsts_.push_back(keys[begin]);
  }
}

void SpatialIndex::split(std::size_t i) {
  Leaf upper;
  Leaf& lower = leaves_[i];
  constexpr std::size_t half = leaf_size / 2;
  upper.keys.assign(at(lower.keys, half), lower.keys.end());
  upper.values.assign(at(lower.values, half), lower.values.end());
  lower.keys.resize(half);
  lower.values.resize(half);
  firsts_.insert(at(firsts_, i + 1), upper.keys.front());
  leaves_.insert(at(leaves_, i + 1), std::move(upper));
}

void SpatialIndex::join_if_small(std::size_t i) {
  if (leaves_[i].keys.empty()) {
    leaves_.erase(at(leaves_, i));
    firsts_.erase(at(firsts_, i));
    return;
  }
  firsts_[i] = leaves_[i].keys.front();
  if (leaves_[i].keys.size() >= leaf_size / 4 || i + 1 == leaves_.size()) return;
  Leaf& lower = leaves_[i];
  const Leaf& upper = leaves_[i + 1];
  if (lower.keys.size() + upper.keys.size() > leaf_size * 3 / 4) return;
  lower.keys.insert(lower.keys.end(), upper.keys.begin(), upper.keys.end());
  lower.values.insert(lower.values.end(), upper.values.begin(), upper.values.end());
  leaves_.erase(at(leaves_, i + 1));
  firsts_.erase(at(firsts_, i + 1));
}

}  // namespace rondel::blocks
