// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "blocks/spatial_index.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace rondel::blocks {
namespace {

template <class Vector>
auto at(Vector& v, std::size_t i) {
  return v.begin() + static_cast<std::ptrdiff_t>(i);
}

std::size_t lower_bound(const std::vector<HilbertKey>& keys, const HilbertKey& key) {
  return static_cast<std::size_t>(std::ranges::lower_bound(keys, key) - keys.begin());
}

}  // namespace

std::size_t SpatialIndex::leaf_of(const HilbertKey& key) const {
  const std::size_t next = lower_bound(firsts_, key);
  return next == 0 ? 0 : next - 1;
}

void SpatialIndex::insert(const HilbertKey& key, Index value) {
  if (leaves_.empty()) {
    leaves_.emplace_back();
    firsts_.push_back(key);
  }
  std::size_t i = leaf_of(key);
  if (leaves_[i].keys.size() == leaf_size) {
    split(i);
    if (firsts_[i + 1] < key) ++i;
  }
  Leaf& leaf = leaves_[i];
  const std::size_t place = lower_bound(leaf.keys, key);
  leaf.keys.insert(at(leaf.keys, place), key);
  leaf.values.insert(at(leaf.values, place), value);
  firsts_[i] = leaf.keys.front();
  ++size_;
}

void SpatialIndex::erase(const HilbertKey& key, Index value) {
  std::size_t i = leaf_of(key);
  std::size_t place = lower_bound(leaves_[i].keys, key);
  for (;;) {
    if (place == leaves_[i].keys.size()) {
      ++i;
      place = 0;
      assert(i < leaves_.size());
    } else if (leaves_[i].values[place] == value) {
      break;
    } else {
      ++place;
    }
  }
  Leaf& leaf = leaves_[i];
  assert(leaf.keys[place] == key);
  leaf.keys.erase(at(leaf.keys, place));
  leaf.values.erase(at(leaf.values, place));
  --size_;
  join_if_small(i);
}

Index SpatialIndex::find(const HilbertKey& key, const std::function<bool(Index)>& is_wanted) const {
  if (leaves_.empty()) return no_index;
  std::size_t i = leaf_of(key);
  for (std::size_t place = lower_bound(leaves_[i].keys, key);; ++place) {
    if (place == leaves_[i].keys.size()) {
      if (++i == leaves_.size()) return no_index;
      place = 0;
    }
    if (leaves_[i].keys[place] != key) return no_index;
    if (is_wanted(leaves_[i].values[place])) return leaves_[i].values[place];
  }
}

Index SpatialIndex::near(const HilbertKey& key) const {
  if (leaves_.empty()) return no_index;
  const Leaf& leaf = leaves_[leaf_of(key)];
  return leaf.values[std::min(lower_bound(leaf.keys, key), leaf.keys.size() - 1)];
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
