// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "dual/face_normal.h"
#include "dual/parts.h"
#include "exact/angles.h"

namespace rondel::dual {
namespace {

constexpr double pi = std::numbers::pi;

// The axis: the normal of three vertices in the order of the ring. Vertices of the weighted model
// may be collinear, all but two of them then have cells without area, and any axis across the line
// will do.
Vec axis_of(const SplitSites& sites) {
  for (Index j = 2; j < sites.order().size(); ++j) {
    if (is_degenerate(sites, 0, j - 1, j)) continue;
    return to_vector(unit_normal(sites, 0, j - 1, j));
  }
  return to_vector(unit_normal(sites, 0, 1, 2));
}

// Two unit vectors across d, so that first, second, d is a right-handed frame.
std::array<Vec, 2> frame_across(const Vec& d) {
  const Vec least = std::abs(d.x) < std::abs(d.y)
                        ? (std::abs(d.x) < std::abs(d.z) ? Vec{1, 0, 0} : Vec{0, 0, 1})
                        : (std::abs(d.y) < std::abs(d.z) ? Vec{0, 1, 0} : Vec{0, 0, 1});
  const Vec first = normalized(cross(least, d));
  return {first, normalized(cross(d, first))};
}

// Rings of up to 4 points, in the order of the sites.
void set_rings(std::span<const Index> vertices, std::span<const std::array<Index, 4>> rings,
               std::size_t num_sites, Cells& cells) {
  std::vector<Index> place(num_sites, no_index);
  for (std::size_t j = 0; j < vertices.size(); ++j) place[vertices[j]] = static_cast<Index>(j);
  for (const Index j : place) {
    cells.rings.append(j == no_index ? std::span<const Index>() : std::span(rings[j]));
  }
}

Cells hemispheres(const SplitSites& sites, std::span<const Index> pair, std::size_t num_sites) {
  const auto [x, y] = frame_across(sites.direction(1, 0));
  Cells cells;
  cells.points = {to_point(x), to_point(y), to_point(-1.0 * x), to_point(-1.0 * y)};
  constexpr std::array<std::array<Index, 4>, 2> rings = {{{0, 1, 2, 3}, {0, 3, 2, 1}}};
  set_rings(pair, rings, num_sites, cells);
  return cells;
}

Cells lunes(const SplitSites& sites, std::span<const Index> ring, std::size_t num_sites) {
  const Vec axis = axis_of(sites);
  const auto k = static_cast<Index>(ring.size());
  Cells cells;
  cells.points = {to_point(axis), to_point(-1.0 * axis)};
  std::vector<std::array<Index, 4>> rings;
  for (Index j = 0; j < k; ++j) {
    const Vec e = sites.direction(j, (j + 1) % k);
    cells.points.push_back(to_point(normalized(cross(e, axis))));
    rings.push_back({0, 2 + (j + k - 1) % k, 1, 2 + j});
  }
  set_rings(ring, rings, num_sites, cells);
  return cells;
}

// Half the angle from a to b about the axis, up to pi. The side is that of the direction, since the
// difference may be below the smallest double.
double half_angle(const SplitSites& sites, const Vec& axis, Index a, Index b) {
  const Vec d = sites.difference(a, b);
  const Vec s = to_vector(sites[a].hi) + to_vector(sites[b].hi);
  const double half = exact::argument(norm(d), norm(s));
  const Vec e = sites.direction(a, b);
  return det(axis, to_vector(sites[a].hi), e) < 0 ? pi - half : half;
}

// The exterior angle of the polygon between the edges from a to b and from b to c.
double exterior_angle(const SplitSites& sites, const Vec& axis, Index a, Index b, Index c) {
  const Offset e = sites.offset(a, b);
  const Offset f = sites.offset(b, c);
  constexpr double underflow_square = 0x1p-900;
  if (std::min(dot(e.hi, e.hi), dot(f.hi, f.hi)) < underflow_square) {
    const Vec from = sites.direction(a, b);
    const Vec to = sites.direction(b, c);
    return std::abs(exact::argument(dot(axis, cross(from, to)), dot(from, to)));
  }
  const double turn = dot(axis, split_cross(e, f).rounded());
  return std::abs(exact::argument(turn, dot(e.hi, f.hi)));
}

double lune_angle(const SplitSites& sites, const Vec& axis, Index a, Index b, Index c) {
  return sites.is_projected() ? half_angle(sites, axis, a, b) + half_angle(sites, axis, b, c)
                              : exterior_angle(sites, axis, a, b, c);
}

// The middle of the lune between the sides of the edges e and f: between e x N
// and f x N, which point to opposite sides at worst.
Vec lune_center(const Vec& e, const Vec& f, const Vec& axis) {
  return normalized(dot(e, f) > 0 ? cross(e + f, axis) : e - f);
}

}  // namespace

Cells great_circle_cells(const Triangulation& triangulation, const SplitSites& sites) {
  const auto ring = triangulation.ring();
  if (ring.size() > 2) return lunes(sites, ring, triangulation.num_sites());
  if (ring.size() == 2) return hemispheres(sites, ring, triangulation.num_sites());
  Cells cells;
  cells.rings.offsets.assign(triangulation.num_sites() + 1, 0);
  return cells;
}

std::vector<double> great_circle_areas(const Triangulation& triangulation,
                                       const SplitSites& sites) {
  const auto ring = triangulation.ring();
  const auto k = static_cast<Index>(ring.size());
  std::vector<double> result(triangulation.num_sites(), 0.0);
  if (k <= 2) {
    for (const Index v : ring) result[v] = 4 * pi / k;
    return result;
  }
  const Vec axis = axis_of(sites);
  for (Index j = 0; j < k; ++j) {
    result[ring[j]] = 2 * lune_angle(sites, axis, (j + k - 1) % k, j, (j + 1) % k);
  }
  return result;
}

std::vector<Point> great_circle_centroids(const Triangulation& triangulation,
                                          const SplitSites& sites) {
  const auto ring = triangulation.ring();
  const auto k = static_cast<Index>(ring.size());
  std::vector<Point> result(triangulation.num_sites());
  if (k < 2) return result;
  const auto edge = [&](Index j) { return sites.direction(j % k, (j + 1) % k); };
  const Vec axis = k == 2 ? Vec{} : axis_of(sites);
  for (Index j = 0; j < k; ++j) {
    result[ring[j]] =
        to_point(k == 2 ? -1.0 * edge(j) : lune_center(edge(j + k - 1), edge(j), axis));
  }
  return result;
}

}  // namespace rondel::dual
