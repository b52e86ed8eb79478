// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that make a mesh, and arithmetic in long double that shares nothing with the library.
#pragma once

#include <cmath>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/mesh.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {

struct LongPoint {
  long double x, y, z;
};
inline LongPoint to_long(const Point& p) { return {p.x, p.y, p.z}; }
inline LongPoint sum(const LongPoint& a, const LongPoint& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LongPoint times(long double s, const LongPoint& a) { return {s * a.x, s * a.y, s * a.z}; }
inline long double inner(const LongPoint& a, const LongPoint& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LongPoint outer(const LongPoint& a, const LongPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline LongPoint unit(const LongPoint& a) { return times(1 / std::sqrt(inner(a, a)), a); }
inline long double arc(const LongPoint& a, const LongPoint& b) {
  const LongPoint n = outer(a, b);
  return std::atan2(std::sqrt(inner(n, n)), inner(a, b));
}
// Van Oosterom and Strackee, with the sign of the orientation.
inline long double signed_area(const LongPoint& a, const LongPoint& b, const LongPoint& c) {
  return 2 * std::atan2(inner(a, outer(b, c)), 1 + inner(a, b) + inner(b, c) + inner(c, a));
}

inline std::vector<Point> mesh_sites(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) sites.push_back(random_direction(random));
  return sites;
}

// The corners of an icosahedron, and k times the middles of all edges.
inline std::vector<Point> icosahedral_sites(int k) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<Point> sites;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-g, g}) {
      sites.push_back(normalized({0, s, t}));
      sites.push_back(normalized({s, t, 0}));
      sites.push_back(normalized({t, 0, s}));
    }
  }
  for (; k > 0; --k) {
    const Triangulation t = delaunay(sites);
    for (const auto& [a, b] : edges(t)) sites.push_back(normalized(sites[a] + sites[b]));
  }
  return sites;
}

}  // namespace rondel::test
