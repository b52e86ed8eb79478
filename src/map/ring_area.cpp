// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "map/ring_area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/vector.h"

namespace rondel::map {

namespace {

// True if two unit vectors are more than 60 degrees apart. The areas of triangles at such a point
// may be ill-defined.
bool is_far(const Point& p, const Point& q) { return dot(p, q) < 0.5; }

// Returns the determinant of three points, from differences of nearby points.
double determinant(const Point& a, const Point& b, const Point& c) {
  return dot(a, cross(b - a, c - a));
}

// Returns a multiple of the approximate center of mass of the region to the left of the ring.
Point moment_of(std::span<const Point> ring) {
  Point sum{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum = sum + cross(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0] - ring[i]);
  }
  return sum;
}

bool is_large(std::span<const Point> ring) {
  return std::ranges::any_of(ring, [&](const Point& p) { return is_far(ring.front(), p); });
}

// Returns how far the antipode of `origin` is from all corners, as half of the least squared
// distance.
double room(std::span<const Point> ring, const Point& origin) {
  double least = 2;
  for (const Point& p : ring) least = std::min(least, 1 + dot(origin, p));
  return least;
}

// Returns a point around which triangles to all sides are well-defined: `first`, or the end of an
// axis that has the most room.
Point origin_for(std::span<const Point> ring, const Point& first) {
  constexpr double enough = 1e-3;
  double most = room(ring, first);
  if (most >= enough) return first;
  Point best = first;
  for (const Point& end : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
    for (const Point& origin : {end, Point{-end.x, -end.y, -end.z}}) {
      const double here = room(ring, origin);
      if (here <= most) continue;
      most = here;
      best = origin;
    }
  }
  return best;
}

// Returns the least and the greatest of 0 and the determinants of the triangles at the first
// corner.
std::pair<double, double> sines_at_first(std::span<const Point> ring) {
  double least = 0;
  double most = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double sine = determinant(ring.front(), ring[i], ring[i + 1]);
    least = std::min(least, sine);
    most = std::max(most, sine);
  }
  return {least, most};
}

// Returns the sum of the triangles of a and each side, brought into [-2 pi, 2 pi]. Triangles are
// known up to multiples of 4 pi, and so is the sum, even where they overlap.
double area_around(const Point& a, std::span<const Point> ring) {
  exact::DoubleDouble area{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& b = ring[i];
    const Point& c = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (b != a && c != a) add_term(exact::triangle_area(a, b, c), area);
  }
  return std::remainder(area.hi + area.lo, 4 * std::numbers::pi);
}

// A triangle with two sides of 60 degrees or less has an area of at most 0.68. So a ring of this
// many corners, which has nine triangles, has less than 2 pi.
constexpr std::size_t few_corners = 11;

// Where all corners are nearer than the chord d to the first one, d^2 <= 0.1, each triangle (a, b, c)
// at that corner with the sine s has the cosine 4 - 3 d^2 or more, since b and c are no farther apart
// than 2 d. Its area 2 atan(s / cosine) differs from s / 2 by less than d^2 |s| / 2: by |s| / 2
// times 3 d^2 / 3.7, and by 2/3 |s / 3.7|^3 with |s| <= d^2. Each sine is off by less than 1e-14 d^2.
bool is_surely_larger_than(std::span<const Point> ring, double area) {
  constexpr double widest = 0.1;
  constexpr double most_sines = 1;  // less than a hemisphere, however often triangles overlap
  double sum = 0;
  double sizes = 0;
  double squared = 0;
  Point before = ring[1] - ring.front();
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const Point step = ring[i] - ring.front();
    const double sine = dot(ring.front(), cross(before, step));
    sum += sine;
    sizes += std::abs(sine);
    squared = std::max({squared, dot(before, before), dot(step, step)});
    before = step;
  }
  if (squared > widest || sizes > most_sines) return false;
  const double rounding = 1e-14 * squared * static_cast<double>(ring.size());
  return std::abs(sum) / 2 > 2 * area + 0.5 * squared * sizes + rounding;
}

}  // namespace

double area_on_left(std::span<const Point> ring) {
  if (ring.empty()) return 0;
  if (!is_large(ring)) return area_around(ring.front(), ring);
  constexpr double least = 1e-12;
  const Point moment = moment_of(ring);
  const bool is_balanced =
      // The ring goes back on itself, or the center of mass of its region is the center of the
      // sphere.
      norm(moment) < least;
  const Point middle = is_balanced ? Point{0, 0, 1} : normalized(moment);
  const double area = area_around(origin_for(ring, middle), ring);
  return is_balanced && std::abs(area) < least ? 0 : area;
}

bool is_clockwise(std::span<const Point> ring) {
  if (ring.size() > few_corners || is_large(ring)) return area_on_left(ring) < 0;
  const auto [least, most] = sines_at_first(ring);
  return least < 0 && most > 0 ? area_on_left(ring) < 0 : least < 0;
}

bool is_surely_larger(std::span<const Point> ring, double area) {
  if (ring.size() > few_corners) return is_surely_larger_than(ring, area);
  if (is_large(ring)) return false;
  const auto [least, most] = sines_at_first(ring);
  // A triangle with sine s and cosine c <= 4 has an area of 2 atan(s / c) >= s / 3, since s <= 1.
  return (least >= 0 && most > 4 * area) || (most <= 0 && least < -4 * area);
}

}  // namespace rondel::map
