// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/hull.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "api/build.h"
#include "api/validation.h"
#include "exact/vector.h"
#include "hidden/inner_point.h"
#include "rondel/error.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

using Vector = exact::Vector3<double>;

// Sums over faces of which the origin is below or in the plane, so that no volume is negative
// but by rounding.
struct Sums {
  double area = 0;
  double volume = 0;

  void add(const Vector& a, const Vector& b, const Vector& c) {
    const Vector n = cross(b - a, c - a);
    area += std::hypot(n.x, n.y, n.z) / 2;
    volume += std::max(dot(a, n), 0.0) / 6;
  }
};

// An exponent e such that no coordinate times 2^-e is larger than 1/2.
int exponent_of(std::span<const Point> points) {
  double largest = 0;
  for (const Point& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  constexpr int least = -1000;  // 2^1000 is finite
  return largest > 0 ? std::max(std::ilogb(largest) + 2, least) : 0;
}

}  // namespace

Triangulation convex_hull(std::span<const Point> points, const HullOptions& options) {
  const system::ArithmeticScope arithmetic;
  Options build_options;
  build_options.model = Model::weighted;
  build_options.threads = options.threads;
  build_options.progress = options.progress;
  api::validate(points, build_options);
  const auto inner = hidden::find_inner_point(points);
  const Point center =
      (inner.is_inside ? hidden::find_middle(points) : std::nullopt).value_or(inner.point);
  // Adding 0 turns -0 into 0: which of them is found first depends on the order of input.
  build_options.sphere.center = {center.x + 0.0, center.y + 0.0, center.z + 0.0};
  return api::build(points, build_options, &inner);
}

Triangulation convex_hull(std::span<const double> xyz, const HullOptions& options) {
  return convex_hull(api::as_points(xyz), options);
}

HullSize size_of_hull(const Triangulation& hull, std::span<const Point> points) {
  const system::ArithmeticScope arithmetic;
  if (points.size() != hull.num_sites()) {
    throw InvalidInput(
        std::to_string(points.size()) + " points for a hull of " + std::to_string(hull.num_sites()),
        0);
  }
  const int exponent = exponent_of(points);
  const double scale = std::ldexp(1.0, -exponent);
  const auto scaled = [scale](const Point& p) {
    return Vector{scale * p.x, scale * p.y, scale * p.z};
  };
  const Vector center = scaled(hull.sphere().center);
  const auto at = [&](Index i) { return scaled(points[i]) - center; };
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

}  // namespace rondel
