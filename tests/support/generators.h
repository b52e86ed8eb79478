// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Named generators of degenerate input. The same name, size and seed give the same sites.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "inputs/kinds.h"
#include "inputs/points.h"
#include "rondel/types.h"
#include "support/random.h"

namespace rondel::test {

struct SiteSet {
  std::vector<Point> sites;
  Sphere sphere{};
};

struct Generator {
  std::string_view name;
  SiteSet (*from)(std::size_t n, std::uint64_t seed);
  bool weighted_only = false;          // a site may be the center
  bool has_long_integers = false;      // slow for the exact oracle
  const inputs::Kind* kind = nullptr;  // of the inputs that all programs share, instead of `from`

  // About n sites; some kinds give a few more or fewer.
  [[nodiscard]] SiteSet make(std::size_t n, std::uint64_t seed) const;
};

// Kinds that mean to lie on a sphere (directions matter), and kinds that fill space (planes, cubes,
// balls, lines: mainly for the weighted model, but with a few exceptions good for both).
std::span<const Generator> spherical_generators();
std::span<const Generator> spatial_generators();
// The ends of the range of doubles, and remote centers.
std::span<const Generator> extreme_generators();
// The hostile kinds of inputs/kinds.h, with _ instead of - in their names.
std::span<const Generator> hostile_generators();
// All, in this order.
std::span<const Generator> generators();
// \pre there is one of this name.
const Generator& generator(std::string_view name);

using inputs::cross_product;
using inputs::moved_by_one_ulp;
using inputs::normalized;
using inputs::random_near;
using inputs::operator+;
using inputs::operator-;
using inputs::operator*;
inline Point random_direction(Random& random) { return random.direction(); }
// The unit vector of a longitude and latitude by the library's own conversion, which gives the
// same bits everywhere; multiples of 90 degrees are exact.
Point unit_vector_deg(double lon, double lat);
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
