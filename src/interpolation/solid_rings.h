// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The vertices around a vertex, ring by ring, along edges of solid faces only, since ghost faces
// join vertices that are far apart.
//
// in    a prepared triangulation, a vertex, a number of rings
// out   vertices
// index spatial ranks
//
// The order depends only on the places: a star goes counterclockwise from its lowest rank, and each
// ring follows the stars of the ring before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/prepared_triangulation.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The first ring of every vertex; all threads share it.
class SolidStars {
 public:
  // Precondition: dimension 2.
  SolidStars(const PreparedTriangulation& prepared, unsigned threads);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] std::span<const Index> operator[](Index v) const { return rows_[v]; }

 private:
  CompressedRows<Index> rows_;  // the other ends of the edges at each vertex
};

// Finds several rings around a vertex. Each thread has its own, since it has an entry for every
// vertex.
class SolidRings {
 public:
  explicit SolidRings(const SolidStars& stars) : stars_(stars), times_(stars.size(), 0) {}

  // Returns all vertices that are at most `rings` edges away from v, without v. Valid until the
  // next call.
  std::span<const Index> find(Index v, unsigned rings);

 private:
  void add_star(Index v);

  const SolidStars& stars_;
  std::vector<Index> found_ = {no_index};  // the first size_ vertices found, beginning with v
  std::size_t size_ = 0;
  std::vector<std::uint32_t> times_;  // by vertex: the time at which it was found
  std::uint32_t time_ = 0;
};

}  // namespace rondel::interpolation
