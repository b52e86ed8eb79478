// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Constrained Delaunay triangulations from the definition by visibility, by brute force in integers
// by GMP. It shares no code with the library, and for each face it tries all sites.
//
// A face is positive, has no other site in it and no part of a constraint inside of it; and no site
// in its (perturbed) circle sees the inside of the face, where constraints stop the view.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "support/oracle.h"

namespace rondel::test {

// Sites in different places, not opposite to each other where a constraint joins them.
class ConstrainedOracle {
 public:
  using Ends = std::array<Index, 2>;

  explicit ConstrainedOracle(std::span<const Point> sites);

  // True if two sites have an arc: they are not opposite to each other.
  [[nodiscard]] bool has_arc(const Ends& ends) const;
  // True if two arcs cross in the inside of both, at no site.
  [[nodiscard]] bool do_cross(const Ends& e, const Ends& f) const;
  // Returns the solid faces, each from its lowest corner on, sorted.
  [[nodiscard]] std::vector<Triple> faces(std::span<const Ends> constraints) const;
  // Returns (low, high, constraint) for each part of a constraint between two sites, sorted.
  [[nodiscard]] std::vector<std::array<Index, 3>> pieces(std::span<const Ends> constraints) const;

 private:
  using Ray = IntegerVector;

  [[nodiscard]] const Ray& ray(Index i) const { return oracle_.vector(i); }
  [[nodiscard]] Index size() const { return static_cast<Index>(oracle_.size()); }
  [[nodiscard]] std::vector<Ray> samples(const Ray& a, const Ray& b,
                                         const std::vector<Ray>& normals) const;
  [[nodiscard]] bool is_empty(const Triple& face) const;
  [[nodiscard]] bool is_passed(const Triple& face, std::span<const Ends> constraints) const;
  [[nodiscard]] bool is_seen(const Triple& face, std::span<const Ends> constraints) const;
  [[nodiscard]] bool is_seen_through(Index a, Index b, Index v,
                                     std::span<const Ends> constraints) const;

  Oracle oracle_;
};

}  // namespace rondel::test
