// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/dynamic_constraints.h"

#include <algorithm>

namespace rondel::constrained {

void DynamicConstraints::assign(std::span<const Ends> ends) {
  ends_.reserve(ends.size());
  for (const Ends& each : ends) {
    make_room(each);
    insert(each);
  }
}

std::vector<Index> DynamicConstraints::ids() const {
  std::vector<Index> ids;
  ids.reserve(size());
  for (Index id = 0; id < limit(); ++id) {
    if (contains(id)) ids.push_back(id);
  }
  return ids;
}

Index DynamicConstraints::first_at(Index site) const {
  Index id = 0;
  while (ends_[id][0] != site && ends_[id][1] != site) ++id;
  return id;
}

void DynamicConstraints::make_room(const Ends& ends) {
  const std::size_t wanted = std::max(ends[0], ends[1]) + std::size_t{1};
  if (num_ends_.size() < wanted) num_ends_.resize(wanted);
  const auto grow = [size = ends_.size() + 1](auto& slots) {
    if (slots.capacity() < size) slots.reserve(2 * size);
  };
  grow(ends_);
  grow(free_);
}

Index DynamicConstraints::insert(const Ends& ends) noexcept {
  const Index id = next_id();
  if (free_.empty()) {
    ends_.push_back(ends);
  } else {
    free_.pop_back();
    ends_[id] = ends;
  }
  for (const Index site : ends) ++num_ends_[site];
  return id;
}

void DynamicConstraints::remove(Index id) noexcept {
  for (const Index site : ends_[id]) --num_ends_[site];
  ends_[id] = {no_index, no_index};
  free_.push_back(id);
}

}  // namespace rondel::constrained
