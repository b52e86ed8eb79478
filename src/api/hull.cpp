// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/hull.h"

#include <cmath>
#include <string>

#include "api/build.h"
#include "api/validation.h"
#include "exact/vector.h"
#include "incremental/inner_point.h"
#include "rondel/error.h"

namespace rondel {
namespace {

using Vector = exact::Vector3<double>;

// Twice the area of the triangle from the origin, as a vector, and six times the volume.
struct Sums {
  double area = 0;
  double volume = 0;

  void add(const Vector& a, const Vector& b, const Vector& c) {
    const Vector n = cross(b - a, c - a);
    area += std::hypot(n.x, n.y, n.z) / 2;
    volume += dot(a, n) / 6;
  }
};

}  // namespace

Triangulation convex_hull(std::span<const Point> points, const HullOptions& options) {
  Options build_options;
  build_options.model = Model::weighted;
  build_options.threads = options.threads;
  build_options.progress = options.progress;
  api::validate(points, build_options);
  const auto inner = incremental::find_inner_point(points);
  // Adding 0 turns -0 into 0: which of them is found first depends on the order of input.
  build_options.sphere.center = {inner.point.x + 0.0, inner.point.y + 0.0, inner.point.z + 0.0};
  return api::build(points, build_options, &inner);
}

Triangulation convex_hull(std::span<const double> xyz, const HullOptions& options) {
  return convex_hull(api::as_points(xyz), options);
}

HullSize size_of_hull(const Triangulation& hull, std::span<const Point> points) {
  if (points.size() != hull.num_sites()) {
    throw InvalidInput(
        std::to_string(points.size()) + " points for a hull of " + std::to_string(hull.num_sites()),
        0);
  }
  const Vector center = exact::to_vector(hull.sphere().center);
  const auto at = [&](Index i) { return exact::to_vector(points[i]) - center; };
  Sums sums;
  for (const auto& [a, b, c] : hull.faces()) sums.add(at(a), at(b), at(c));
  const auto ring = hull.ring();
  for (std::size_t i = 2; i < ring.size(); ++i) {
    sums.add(at(ring[0]), at(ring[i - 1]), at(ring[i]));
  }
  if (hull.dimension() < 2) return {0, 2 * sums.area};
  return {sums.volume, sums.area};
}

}  // namespace rondel
