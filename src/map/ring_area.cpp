// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "map/ring_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/argument.h"
#include "exact/vector.h"

namespace rondel::map {

namespace {

// Triangles at a point more than 60 degrees away may be ill-defined.
bool is_far(const Point& p, const Point& q) { return dot(p, q) < 0.5; }

double triangle_area(const Point& a, const Point& b, const Point& c) {
  const double sine = dot(a, cross(b - a, c - a));
  const double cosine = 1 + dot(a, b) + dot(b, c) + dot(c, a);
  const double half = exact::argument(std::abs(sine), cosine);
  return sine < 0 ? -2 * half : 2 * half;
}

// A multiple of about the center of mass of the region to the left of the ring.
Point moment_of(std::span<const Point> ring) {
  Point sum{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum = sum + cross(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0] - ring[i]);
  }
  return sum;
}

}  // namespace

double area_on_left(std::span<const Point> ring) {
  const bool is_large =
      std::ranges::any_of(ring, [&](const Point& p) { return is_far(ring.front(), p); });
  Point a = ring.front();
  if (is_large) {
    constexpr double least = 1e-12;
    const Point moment = moment_of(ring);
    if (norm(moment) < least) return 0;  // a line to and fro
    a = normalized(moment);
  }
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& b = ring[i];
    const Point& c = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (b != a && c != a) area += triangle_area(a, b, c);
  }
  return std::remainder(area, 4 * std::numbers::pi);
}

}  // namespace rondel::map
