// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The convex hull: find a center inside the points, then triangulate with Model::weighted around
// it. The sizes are sums over faces, scaled by a power of two so that nothing overflows meanwhile.

#include "rondel/hull.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "api/build.h"
#include "api/validation.h"
#include "exact/vector.h"
#include "hidden/inner_point.h"
#include "predicates/orientation.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

// Sums over faces a, b, c as seen from the origin, in units of the scaled points. The origin is
// below each face or in its plane, so a negative volume comes from rounding and counts as 0.
struct Sums {
  double area = 0;
  double volume = 0;

  void add(const Point& a, const Point& b, const Point& c) {
    const Point n = cross(b - a, c - a);
    area += exact::length_of(n) / 2;
    volume += std::max(dot(a, n), 0.0) / 6;
  }
};

// Returns an exponent e such that no coordinate times 2^-e is larger than 1/2; 0 if all are 0.
int exponent_of(std::span<const Point> points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max(largest, largest_coordinate(p));
  constexpr int least = -1000;  // 2^1000 is finite
  return largest > 0 ? std::max(std::ilogb(largest) + 2, least) : 0;
}

// Returns volume and area in units of the points: sums over the faces, or over a fan of the ring
// for a flat hull, whose polygon counts with both sides.
HullSize sum_of_faces(const Triangulation& hull) {
  const auto points = hull.sites().points();
  const int exponent = exponent_of(points);
  const double scale = std::ldexp(1.0, -exponent);
  const Point center = scale * hull.sphere().center;
  const auto at = [&](Index i) { return scale * points[i] - center; };
  Sums sums;
  for (const auto& [a, b, c] : hull.faces()) sums.add(at(a), at(b), at(c));
  const auto ring = hull.ring();
  for (std::size_t i = 2; i < ring.size(); ++i) {
    sums.add(at(ring[0]), at(ring[i - 1]), at(ring[i]));
  }
  const bool is_flat = hull.dimension() < 2;
  return {is_flat ? 0 : std::ldexp(sums.volume, 3 * exponent),
          std::ldexp(is_flat ? 2 * sums.area : sums.area, 2 * exponent)};
}

// Throws InvalidInput unless the faces are those of a hull around the center, from which the sums
// are taken: the center is below each face or in its plane.
void require_hull(const Triangulation& hull) {
  if (hull.model() == Model::projected && hull.num_sites() > 0) {
    throw InvalidInput("the faces of projected sites are no hull; convex_hull() makes one");
  }
  const auto points = hull.sites().points();
  for (const Index f : hull.ghost_faces()) {
    const auto& [a, b, c] = hull.faces()[f];
    if (predicates::orientation(points[a], points[b], points[c], hull.sphere().center).sign ==
        Sign::negative) {
      throw InvalidInput("the center is outside of the hull; convex_hull() chooses one inside");
    }
  }
}

}  // namespace

Triangulation convex_hull(Sites points, const Execution& execution) {
  const system::Call call(execution);
  system::Job job{{.model = Model::weighted}, execution};
  api::validate(points.points(), job);
  // The middle of the box is preferred, since blocks need a center that is about equally far from
  // all. A flat hull has no point inside: then the center is one of the points.
  const auto inner = hidden::find_inner_point(points.points());
  const Point center =
      (inner.is_inside ? hidden::find_middle(points.points()) : std::nullopt).value_or(inner.point);
  // Adding 0 turns -0 into 0: which of them is found first depends on the order of input.
  job.sphere.center = {center.x + 0.0, center.y + 0.0, center.z + 0.0};
  return api::build(std::move(points), job, &inner);
}

Triangulation convex_hull(std::span<const double> xyz, const Execution& execution) {
  return convex_hull(Sites(api::as_points(xyz)), execution);
}

HullSize size_of_hull(const Triangulation& hull) {
  const system::ArithmeticScope arithmetic;
  require_hull(hull);
  return system::apart([&] { return sum_of_faces(hull); });
}

}  // namespace rondel
