// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The answers to queries by brute force over all vertices and faces, with GMP and MPFR.
#pragma once

#include <span>
#include <vector>

#include "rondel/query.h"
#include "rondel/triangulation.h"
#include "support/oracle.h"
#include "support/random.h"

namespace rondel::test {

class QueryOracle {
 public:
  QueryOracle(const Triangulation& triangulation, std::span<const Point> sites,
              std::span<const Point> queries);

  // All vertices in order of distance from a query, of equal ones the lower index first.
  [[nodiscard]] std::vector<Index> by_distance(std::size_t query) const;
  // Positive: vertex a is nearer.
  [[nodiscard]] int compare(std::size_t query, Index a, Index b) const;
  // Exact, with the distance clamped as in Locator::distance.
  [[nodiscard]] bool is_at_distance_0(std::size_t query, Index site) const;
  // The exact distance minus `angle`, rounded.
  [[nodiscard]] double distance_minus(std::size_t query, Index site, double angle) const;
  [[nodiscard]] Location locate(std::size_t query) const;

 private:
  [[nodiscard]] Location locate_on_surface(std::size_t query) const;
  [[nodiscard]] Location locate_on_ring(std::size_t query) const;
  [[nodiscard]] bool is_on_ray(std::size_t query, Index site) const;
  // The length 1 among the vectors of the weighted model.
  [[nodiscard]] mpz_class unit() const;
  [[nodiscard]] std::size_t row(std::size_t query) const { return num_sites_ + query; }

  const Triangulation& triangulation_;
  std::size_t num_sites_;
  std::vector<Index> vertices_;
  Oracle oracle_;
};

// Directions of every kind: random, along axes, to and opposite to sites, between two and three.
std::vector<Point> query_points(std::span<const Point> sites, const Point& center, Random& random);

}  // namespace rondel::test
