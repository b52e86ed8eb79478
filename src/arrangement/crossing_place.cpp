// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cross product of the normals a x (b - a) and c x (d - c) is on the line through the crossing.
// It is computed in double-double, or, where that loses too much, as balls of more and more words.
#include "arrangement/crossing_place.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include "arrangement/arc_checks.h"
#include "arrangement/noded_arcs.h"
#include "exact/ball.h"
#include "exact/eft.h"
#include "exact/exact_sign.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"

namespace rondel::arrangement {
namespace {

using exact::DoubleDouble;
using Quads = exact::Vector3<DoubleDouble>;

// Returns the result by double-double, unless its error may matter. Differences of doubles are exact
// as sums of two. So normals are off by 2^-102 of the steps, and the line by 2^-100 of the product
// of both steps. A coordinate is known if that is less than a 2^20th of its unit in the last place.
std::optional<Point> quick_place(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Quads line = cross(precise_normal_of(a, b), precise_normal_of(c, d));
  constexpr double least = 0x1p-26;
  const double bound = least * largest_coordinate(b - a) * largest_coordinate(d - c);
  if (!(bound > 0x1p-150) || !(std::abs(line.x.hi) > bound) || !(std::abs(line.y.hi) > bound) ||
      !(std::abs(line.z.hi) > bound)) {
    return std::nullopt;
  }
  return exact::scaled_to_unit(line, exact::squared_norm(line)).hi;
}

// Returns the double nearest to a ball's midpoint.
template <std::size_t N>
double nearest_double(const exact::Ball<N>& ball) {
  const double first = exact::leading_double(ball);
  return first + exact::leading_double(ball.midpoint() - exact::Ball<N>(first));
}

// True if a ball is 0, or known to so many bits that rounding rarely depends on the others.
template <std::size_t N>
bool is_known(const exact::Ball<N>& ball) {
  constexpr int needed_bits = 100;
  return ball.is_exact() || ball.radius() < ball.size_of_midpoint() - needed_bits;
}

template <std::size_t N>
std::optional<Point> place_with_words(const Point& a, const Point& b, const Point& c,
                                      const Point& d) {
  const exact::BallStep<N> step;
  const auto normal = [&](const Point& p, const Point& q) {
    return cross(step(Point{}, p), step(p, q));
  };
  const exact::BallVector<N> line = cross(normal(a, b), normal(c, d));
  if (!is_known(line.x) || !is_known(line.y) || !is_known(line.z)) return std::nullopt;
  const auto root = exact::inverse_square_root(dot(line, line));
  if (!root) return std::nullopt;
  return Point{nearest_double(line.x * *root), nearest_double(line.y * *root),
               nearest_double(line.z * *root)};
}

}  // namespace

Point crossing_place(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::optional<Point> place = quick_place(a, b, c, d);
  if (!place) place = place_with_words<8>(a, b, c, d);
  if (!place) place = place_with_words<24>(a, b, c, d);
  // Coordinates are multiples of 2^-1074 below 2, and the product has four of them.
  if (!place) place = place_with_words<144>(a, b, c, d);
  assert(place);
  // Smaller coordinates would be refused where the result is input again.
  for (double* const coordinate : {&place->x, &place->y, &place->z}) {
    if (std::abs(*coordinate) < least_coordinate) *coordinate = 0;
  }
  return dot(*place, a + b) < 0 ? -1.0 * *place : *place;
}

}  // namespace rondel::arrangement
