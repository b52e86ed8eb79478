// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/region_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/vector.h"
#include "map/ring_area.h"
#include "overlay/measure.h"
#include "predicates/bounds.h"

namespace rondel::overlay {
namespace {

constexpr double whole_area = 4 * std::numbers::pi;

// Returns the sum of the triangles of a point o with each side from p to q. With d = q - p,
//
//     tan(area / 2) = o.((p - o) x d) / (1 + o.p + p.q + q.o) = s / c.
//
// s is off by 10 u |p - o| |d| with |p - o| <= 2, and c by 12 u, so the angle is off by less than
// 32 u |d| (1 + |d|) / (s^2 + c^2), where that is less than 1. Corners are off by 2 u, or some 10 u
// where they are crossings (area_of_rounding()); that moves the area by 16 u |d|, which is the
// bound where the triangles are small, s^2 + c^2 = 16.
RingArea area_around(std::span<const Point> ring, const Point& origin) {
  constexpr double factor = 64 * predicates::unit_roundoff;
  constexpr double max_square = 4;
  constexpr double min_square = 1e-20;
  RingArea result;
  exact::DoubleDouble sum{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& p = ring[i];
    const Point& q = ring[i + 1 < ring.size() ? i + 1 : 0];
    const Point d = q - p;
    const double above = dot(origin, cross(p - origin, d));
    const double below = 1 + dot(origin, p) + dot(p, q) + dot(q, origin);
    const double angle = 2 * exact::argument(std::abs(above), below);
    add_term(above < 0 ? -angle : angle, sum);
    const double square = std::clamp(above * above + below * below, min_square, max_square);
    result.rounding += factor * rough_length(p, q) / square;
  }
  result.area = std::remainder(sum.hi + sum.lo, whole_area);
  return result;
}

// Returns the area of a ring from the point from which it is known best: the first corner, or an
// end of an axis.
RingArea best_area_of_ring(std::span<const Point> ring) {
  RingArea best = area_around(ring, ring.front());
  for (const Point& end : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
    for (const Point& origin : {end, Point{-end.x, -end.y, -end.z}}) {
      const RingArea other = area_around(ring, origin);
      if (other.rounding < best.rounding) best = other;
    }
  }
  return best;
}

// Returns a bound for the error of area_on_left().
double unsure_area(std::size_t num_corners) {
  constexpr double of_any = 1e-9;
  constexpr double per_corner = 1e-14;
  return of_any + per_corner * static_cast<double>(num_corners);
}

}  // namespace

RingArea area_of_ring(std::span<const Point> ring) {
  if (ring.empty()) return {};
  const double area = map::area_on_left(ring);
  const double unsure = unsure_area(ring.size());
  if (std::abs(area) > unsure) return {area, unsure};
  return best_area_of_ring(ring);
}

void RegionArea::add(std::span<const Point> ring) {
  if (ring.empty()) return;
  add_term(map::area_on_left(ring), sum_);
  points_.insert(points_.end(), ring.begin(), ring.end());
  ends_.push_back(points_.size());
}

double RegionArea::value() const {
  const double total = sum_.hi + sum_.lo;
  const double least = std::remainder(total, whole_area);
  if (std::abs(least) > unsure_area(points_.size())) {
    if (total > 0 && total < whole_area) return total;
    return least < 0 ? least + whole_area : least;
  }
  exact::DoubleDouble sum{};
  double rounding = 0;
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    const RingArea ring = best_area_of_ring(std::span(points_).subspan(begin, end - begin));
    add_term(ring.area, sum);
    rounding += ring.rounding;
    begin = end;
  }
  const double area = std::remainder(sum.hi + sum.lo, whole_area);
  return area < -rounding ? area + whole_area : std::max(area, 0.0);
}

}  // namespace rondel::overlay
