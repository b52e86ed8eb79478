// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Named generators of degenerate input. The same name, size and seed give the same sites.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/types.h"
#include "support/random.h"

namespace rondel::test {

struct SiteSet {
  std::vector<Point> sites;
  Sphere sphere{};
};

struct Generator {
  std::string_view name;
  // About n sites; some kinds give a few more or fewer.
  SiteSet (*make)(std::size_t n, std::uint64_t seed);
  bool weighted_only = false;      // a site may be the center
  bool has_long_integers = false;  // slow for the exact oracle
};

// Kinds that mean to lie on a sphere (directions matter), and kinds that fill space (planes, cubes,
// balls, lines: mainly for the weighted model, but with a few exceptions good for both).
std::span<const Generator> spherical_generators();
std::span<const Generator> spatial_generators();
// The ends of the range of doubles, and remote centers.
std::span<const Generator> extreme_generators();
// All, in this order.
std::span<const Generator> generators();
// \pre there is one of this name.
const Generator& generator(std::string_view name);

// The exactly reproducible pieces of which generators are made.
Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(double s, const Point& p);
Point cross_product(const Point& a, const Point& b);
Point normalized(const Point& p);
Point random_direction(Random& random);
// A unit vector at most about `radius` (in radians) away from `pole`.
Point random_near(Random& random, const Point& pole, double radius);
// The unit vector of a longitude and latitude, as good as the C library's sine except that
// multiples of 90 degrees are exact and opposite angles give opposite bits.
Point unit_vector_deg(double lon, double lat);
// One coordinate moved to a neighboring double.
Point moved_by_one_ulp(Random& random, Point p);
// The paper's S_n (section 5): n + 1 points of a spiral and four more.
std::vector<Point> paper_s(std::size_t n);
// All integer points at squared distance `square` from the origin, shuffled.
std::vector<Point> integer_sphere(int square, Random& random);

// How often to repeat random tests: `count` times RONDEL_TEST_SCALE (default 1), at least once.
std::size_t scaled(std::size_t count);
// Whether RONDEL_TEST_SCALE is below 1, where tests that are long without repeating anything take
// less.
bool is_shortened();

}  // namespace rondel::test
