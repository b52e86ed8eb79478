// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cross product of the normals a x (b - a) and c x (d - c) is on the line through the crossing.
// It is computed in double-double, or, where that loses too much, as balls of more and more words.
#include "arrangement/crossing_place.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "arrangement/arc_checks.h"
#include "arrangement/noded_arcs.h"
#include "exact/ball.h"
#include "exact/eft.h"
#include "exact/exact_sign.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "system/wide_vectors.h"

namespace rondel::arrangement {
namespace {

using exact::DoubleDouble;
using Quads = exact::Vector3<DoubleDouble>;

// Crossings at a time, number by number, so that the compiler makes vector code.
constexpr std::size_t batch_size = 16;
using Numbers = std::array<double, batch_size>;

struct PointLanes {
  alignas(64) Numbers x;
  alignas(64) Numbers y;
  alignas(64) Numbers z;

  void set(std::size_t i, const Point& p) {
    x[i] = p.x;
    y[i] = p.y;
    z[i] = p.z;
  }
  [[nodiscard]] RONDEL_ALWAYS_INLINE Point get(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

struct CrossingLanes {
  PointLanes a;
  PointLanes b;
  PointLanes c;
  PointLanes d;
  PointLanes place;
  alignas(64) Numbers is_known;
};

RONDEL_ALWAYS_INLINE inline double larger(double x, double y) { return x < y ? y : x; }

RONDEL_ALWAYS_INLINE inline double size_of_step(const Point& a, const Point& b) {
  return larger(larger(std::abs(b.x - a.x), std::abs(b.y - a.y)), std::abs(b.z - a.z));
}

// Finds a place by double-double, and whether its error cannot matter. Differences of doubles are
// exact as sums of two. So normals are off by 2^-102 of the steps, and the line by 2^-100 of the
// product of both steps. A coordinate is known if that is less than a 2^20th of its unit in the last
// place.
RONDEL_ALWAYS_INLINE inline void find_place(CrossingLanes& lanes, std::size_t i) {
  const Point a = lanes.a.get(i);
  const Point b = lanes.b.get(i);
  const Point c = lanes.c.get(i);
  const Point d = lanes.d.get(i);
  const Quads line = cross(precise_normal_of(a, b), precise_normal_of(c, d));
  constexpr double least = 0x1p-26;
  const double bound = least * size_of_step(a, b) * size_of_step(c, d);
  const std::uint64_t is_known =
      system::mask(bound > 0x1p-150) & system::mask(std::abs(line.x.hi) > bound) &
      system::mask(std::abs(line.y.hi) > bound) & system::mask(std::abs(line.z.hi) > bound);
  const exact::SplitPoint unit = exact::scaled_to_unit(line, exact::squared_norm(line));
  lanes.place.x[i] = unit.hi.x;
  lanes.place.y[i] = unit.hi.y;
  lanes.place.z[i] = unit.hi.z;
  lanes.is_known[i] = system::choose(is_known, 1, 0);
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

// Returns the place where double-double does not suffice.
Point place_with_enough_words(const CrossingEnds& crossing) {
  const auto& [a, b, c, d] = crossing;
  std::optional<Point> place = place_with_words<8>(a, b, c, d);
  if (!place) place = place_with_words<24>(a, b, c, d);
  // Coordinates are multiples of 2^-1074 below 2, and the product has four of them.
  if (!place) place = place_with_words<144>(a, b, c, d);
  assert(place);
  return *place;
}

// Returns the place on the side of the arcs.
Point finished(Point place, const CrossingEnds& crossing) {
  // Smaller coordinates would be refused where the result is input again.
  for (double* const coordinate : {&place.x, &place.y, &place.z}) {
    if (std::abs(*coordinate) < least_coordinate) *coordinate = 0;
  }
  return dot(place, crossing.a + crossing.b) < 0 ? -1.0 * place : place;
}

}  // namespace

void crossing_places(std::span<const CrossingEnds> crossings, std::span<Point> places) {
  CrossingLanes lanes;
  for (std::size_t begin = 0; begin < crossings.size(); begin += batch_size) {
    const std::size_t count = std::min(batch_size, crossings.size() - begin);
    for (std::size_t i = 0; i < batch_size; ++i) {
      const CrossingEnds& crossing = crossings[begin + std::min(i, count - 1)];
      lanes.a.set(i, crossing.a);
      lanes.b.set(i, crossing.b);
      lanes.c.set(i, crossing.c);
      lanes.d.set(i, crossing.d);
    }
    system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
      for (std::size_t i = 0; i < batch_size; ++i) find_place(lanes, i);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const CrossingEnds& crossing = crossings[begin + i];
      const bool is_known = lanes.is_known[i] > 0;
      places[begin + i] =
          finished(is_known ? lanes.place.get(i) : place_with_enough_words(crossing), crossing);
    }
  }
}

Point crossing_place(const Point& a, const Point& b, const Point& c, const Point& d) {
  const CrossingEnds crossing = {a, b, c, d};
  Point place;
  crossing_places({&crossing, 1}, {&place, 1});
  return place;
}

}  // namespace rondel::arrangement
