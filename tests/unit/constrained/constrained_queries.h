// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points to be located in constrained triangulations whose faces are far from Delaunay, and where
// they are, by the public orientation and all faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/predicates.h"
#include "rondel/query.h"
#include "support/generators.h"

namespace rondel::test {

using Ends = std::array<Index, 2>;

// The location by the signs of a query and all edges: the first solid face that has it.
inline Location expected_location(const Triangulation& t, const Point& query) {
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    const Triple& face = t.faces()[f];
    std::array<Sign, 3> side{};
    for (unsigned i = 0; i < 3; ++i) {
      side[i] = orientation(t.sites()[face[(i + 1) % 3]], t.sites()[face[(i + 2) % 3]], query,
                            t.sphere());
    }
    if (std::ranges::count(side, Sign::negative) > 0) continue;
    const auto zeros = std::ranges::count(side, Sign::zero);
    if (zeros == 0) return {Where::face, f, face};
    if (zeros == 1) {
      const auto i = static_cast<std::size_t>(std::ranges::find(side, Sign::zero) - side.begin());
      const auto [low, high] = std::minmax(face[(i + 1) % 3], face[(i + 2) % 3]);
      return {Where::edge, f, {low, high, no_index}};
    }
    const auto i = static_cast<std::size_t>(std::ranges::find(side, Sign::positive) - side.begin());
    return {Where::vertex, f, {face[i], no_index, no_index}};
  }
  return {};
}

// Constraints that do not cross, many of them long: so that many faces are far from Delaunay.
inline std::vector<Ends> long_constraints(const SiteSet& set, std::size_t wanted, Random& random) {
  std::vector<Ends> constraints;
  for (std::size_t k = 0; k < wanted; ++k) {
    constraints.push_back({static_cast<Index>(random.below(set.sites.size())),
                           static_cast<Index>(random.below(set.sites.size()))});
    try {
      static_cast<void>(constrained_delaunay(set.sites, constraints, {.sphere = set.sphere}));
    } catch (const InvalidInput&) {
      constraints.pop_back();
    }
  }
  return constraints;
}

inline std::vector<Point> queries_of(const SiteSet& set, Random& random) {
  const Point& center = set.sphere.center;
  std::vector<Point> queries;
  for (std::size_t k = 0; k < 60; ++k) {
    const Point& p = set.sites[random.below(set.sites.size())];
    const Point& q = set.sites[random.below(set.sites.size())];
    queries.push_back(p);
    queries.push_back(center + random_direction(random));
    queries.push_back(0.5 * p + 0.5 * q);
    queries.push_back(center + (center - p));
  }
  std::erase_if(queries, [&](const Point& p) {
    return p == center || !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
  });
  return queries;
}

}  // namespace rondel::test
