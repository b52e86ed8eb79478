// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The vertices around a vertex, ring by ring, along edges of solid faces only: ghost faces join what is
// far apart.
//
// The order depends on places alone: a star goes counterclockwise from its lowest rank, and the next
// ring follows the stars of this one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/ground.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The first ring of every vertex, for all threads.
class SolidStars {
 public:
  // Precondition: dimension 2.
  SolidStars(const Ground& ground, unsigned threads);

  [[nodiscard]] std::size_t size() const { return offsets_.size() - 1; }
  [[nodiscard]] std::span<const Index> operator[](Index v) const {
    return {ends_.data() + offsets_[v], offsets_[v + 1] - offsets_[v]};
  }

 private:
  std::vector<std::uint64_t> offsets_;
  std::vector<Index> ends_;
};

// Finds several rings. One a thread: it has a place for every vertex, which takes time to make.
class SolidRings {
 public:
  explicit SolidRings(const SolidStars& stars) : stars_(stars), times_(stars.size(), 0) {}

  // All vertices at most so many edges from v, without v itself; until the next call.
  std::span<const Index> find(Index v, unsigned rings);

 private:
  void add_star(Index v);

  const SolidStars& stars_;
  std::vector<Index> found_ = {no_index};  // the first size_ of them, v itself before all
  std::size_t size_ = 0;
  std::vector<std::uint32_t> times_;  // when each vertex was found
  std::uint32_t time_ = 0;
};

}  // namespace rondel::interpolation
