// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// orientation, side_of_circle, is_in_conflict, is_same_site of very many quadruples: an input is a
// family and a seed, from which 1,000 quadruples are drawn (16 where the oracle is GMP). Each sign
// is compared with that of an oracle in 128-bit integers or, where these do not reach, in GMP.
#include <algorithm>
#include <array>
#include <cmath>

#include "fuzz/fuzz_input.h"
#include "rondel/predicates.h"
#include "support/integer_oracle.h"
#include "support/oracle.h"
#include "support/random.h"

namespace rondel::fuzz {
namespace {

using test::IntegerRay;
using test::Random;
using Quadruple = std::array<IntegerRay, 4>;

int value_of(Sign sign) { return static_cast<int>(sign); }

std::int64_t integer(Random& random, std::int64_t most) {
  const auto width = static_cast<std::uint64_t>(2 * most + 1);
  return static_cast<std::int64_t>(random.next() % width) - most;
}

IntegerRay any_ray(Random& random, std::int64_t most) {
  return {integer(random, most), integer(random, most), integer(random, most)};
}

IntegerRay combined(std::int64_t i, const IntegerRay& a, std::int64_t j, const IntegerRay& b) {
  return {i * a.x + j * b.x, i * a.y + j * b.y, i * a.z + j * b.z};
}

IntegerRay sum(const IntegerRay& a, const IntegerRay& b) { return combined(1, a, 1, b); }

// One of the 48 mirror images, all at the same distance from the center.
IntegerRay image(Random& random, IntegerRay a) {
  const std::uint64_t how = random.next();
  if ((how & 1U) != 0) a.x = -a.x;
  if ((how & 2U) != 0) a.y = -a.y;
  if ((how & 4U) != 0) a.z = -a.z;
  if ((how & 8U) != 0) std::swap(a.x, a.y);
  if ((how & 16U) != 0) std::swap(a.y, a.z);
  if ((how & 32U) != 0) std::swap(a.x, a.z);
  return a;
}

// Mostly nothing, otherwise a smallest step.
IntegerRay step(Random& random) { return random.below(4) != 0 ? IntegerRay{} : any_ray(random, 1); }

// Exact: 40 bits of mantissa, and an exponent from -1074 to 960.
Point scaled(const IntegerRay& a, int exponent) {
  const double unit = exponent == 0 ? 1 : std::ldexp(1, exponent);
  return {static_cast<double>(a.x) * unit, static_cast<double>(a.y) * unit,
          static_cast<double>(a.z) * unit};
}

int any_exponent(Random& random) {
  switch (random.below(16)) {
    case 0:
      return random.between(-1074, 960);
    case 1:
    case 2:
      return random.between(-60, 20);
    default:
      return 0;
  }
}

bool is_center(const IntegerRay& a) { return a == IntegerRay{}; }

// The center, the exponent that all have in common, and where sites stand for rays one for each.
struct Scaling {
  Sphere sphere;
  std::array<int, 4> exponents{};
  IntegerRay center;
};

Scaling one_scale(Random& random) {
  Scaling scaling;
  scaling.exponents.fill(any_exponent(random));
  if (random.below(4) == 0) scaling.center = any_ray(random, 1 << random.below(8));
  scaling.sphere.center = scaled(scaling.center, scaling.exponents[0]);
  return scaling;
}

// Rays from the origin have a scale each.
Scaling scale_for_each_ray(Random& random) {
  Scaling scaling = one_scale(random);
  if (!is_center(scaling.center)) return scaling;
  for (int& exponent : scaling.exponents) exponent = any_exponent(random);
  return scaling;
}

std::array<Point, 4> placed(const Quadruple& q, const Scaling& scaling) {
  std::array<Point, 4> points;
  for (std::size_t i = 0; i < 4; ++i) {
    points[i] = scaled(sum(q[i], scaling.center), scaling.exponents[i]);
  }
  return points;
}

void compare_side(const Quadruple& q, const Scaling& scaling, Model model, int expected) {
  const auto [a, b, c, p] = placed(q, scaling);
  require(value_of(side_of_circle(a, b, c, p, model, scaling.sphere)) == expected,
          "side_of_circle is that of the integers");
  if (expected == 0) return;
  require(is_in_conflict(a, b, c, p, model, scaling.sphere) == (expected > 0),
          "is_in_conflict is that of the integers");
}

void compare_orientation(const Quadruple& q, const Scaling& scaling) {
  const auto [a, b, c, p] = placed(q, scaling);
  require(value_of(orientation(a, b, p, scaling.sphere)) ==
              test::sign_of(test::determinant(q[0], q[1], q[3])),
          "orientation is that of the integers");
  if (std::ranges::any_of(q, is_center)) return;
  require(is_same_site(c, p, Model::projected, scaling.sphere) == test::are_on_one_ray(q[2], q[3]),
          "is_same_site is that of the integers");
}

// Space: points of up to 38 bits, the last one often in or next to the plane of the others.
void test_space(Random& random) {
  const int bits = random.between(1, 38);
  const std::int64_t most = std::int64_t{1} << bits;
  Quadruple q;
  for (IntegerRay& a : q) a = any_ray(random, most);
  if (random.below(4) == 0) {
    const std::int64_t few = std::int64_t{1} << std::min(bits / 2, 17);
    for (std::size_t i = 0; i < 3; ++i) q[i] = any_ray(random, few);
    const IntegerRay along =
        combined(integer(random, few), q[1] - q[0], integer(random, few), q[2] - q[0]);
    q[3] = sum(sum(q[0], along), step(random));
  }
  compare_side(q, one_scale(random), Model::weighted, test::side_of_plane(q[0], q[1], q[2], q[3]));
}

// Directions of up to 40 bits, the last one often in or next to a plane of two.
void test_directions(Random& random) {
  const int bits = random.between(1, 38);
  Quadruple q;
  for (IntegerRay& a : q) a = any_ray(random, std::int64_t{1} << bits);
  if (random.below(4) == 0) {
    const std::int64_t few = std::int64_t{1} << std::min(bits / 2, 18);
    for (std::size_t i = 0; i < 3; ++i) q[i] = any_ray(random, few);
    q[3] = sum(combined(integer(random, few), q[0], integer(random, few), q[1]), step(random));
  }
  if (random.below(8) == 0) q[2] = combined(random.between(-3, 3), q[3], 1, step(random));
  compare_orientation(q, scale_for_each_ray(random));
}

// Rays through points of a small grid, at any distance: circles with very many ties.
void test_grid(Random& random) {
  const std::int64_t most = random.between(1, static_cast<int>(test::max_for_roots));
  Quadruple q;
  for (IntegerRay& a : q) a = any_ray(random, most);
  if (random.below(16) == 0) {
    for (std::size_t i = 1; i < 4; ++i) q[i] = image(random, q[0]);
  }
  if (std::ranges::any_of(q, is_center)) return;
  const int expected = test::side_of_circle(q[0], q[1], q[2], q[3]);
  compare_side(q, scale_for_each_ray(random), Model::projected, expected);
}

// Integer points of one sphere, at any distance: the circle's plane is that of the points.
void test_sphere(Random& random) {
  const IntegerRay first = any_ray(random, std::int64_t{1} << random.between(1, 38));
  if (is_center(first)) return;
  Quadruple q;
  for (IntegerRay& a : q) a = image(random, first);
  compare_side(q, scale_for_each_ray(random), Model::projected,
               test::side_of_plane(q[0], q[1], q[2], q[3]));
}

// Any doubles, also such whose exponents differ, rays next to each other and next to one
// sphere: the oracle is GMP. Ties are compared as they are broken.
void test_doubles(Random& random) {
  std::vector<Point> sites;
  const int spread = random.coin() ? 2 : random.between(2, 300);
  const auto any = [&] { return random.signed_unit() * std::ldexp(1, random.between(-spread, 2)); };
  const IntegerRay first = any_ray(random, 1 << random.between(1, 9));
  const bool is_sphere = random.coin();
  for (std::size_t i = 0; i < 4; ++i) {
    Point p = {any(), any(), any()};
    if (is_sphere) {
      const IntegerRay far = combined(1 + random.between(0, 2047), image(random, first), 1, {});
      p = scaled(sum(far, step(random)), any_exponent(random));
    } else if (i > 0 && random.coin()) {
      p = sites[random.below(i)];
      double& x = random.coin() ? p.x : random.coin() ? p.y : p.z;
      x = std::nextafter(x, random.coin() ? 2 * x : 0);
    }
    if (p == Point{}) return;
    sites.push_back(p);
  }
  for (const Model model : {Model::projected, Model::weighted}) {
    const test::Oracle oracle(sites, model, {});
    const int expected = oracle.side_of_circle(0, 1, 2, 3);
    require(value_of(side_of_circle(sites[0], sites[1], sites[2], sites[3], model)) == expected,
            "side_of_circle is that of the oracle");
    require(value_of(orientation(sites[1], sites[2], sites[3])) == oracle.orientation(1, 2, 3),
            "orientation is that of the oracle");
    bool are_distinct = true;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool is_same = oracle.is_same_site(i, j);
        require(is_same_site(sites[i], sites[j], model) == is_same,
                "is_same_site is that of the oracle");
        are_distinct = are_distinct && !is_same;
      }
    }
    if (!are_distinct || oracle.is_flat()) continue;
    require(is_in_conflict(sites[0], sites[1], sites[2], sites[3], model) ==
                (oracle.perturbed_side(0, 1, 2, 3) > 0),
            "is_in_conflict is that of the oracle");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  constexpr std::array families = {fuzz::test_space,      fuzz::test_space,  fuzz::test_space,
                                   fuzz::test_directions, fuzz::test_grid,   fuzz::test_directions,
                                   fuzz::test_sphere,     fuzz::test_doubles};
  fuzz::ByteSource source(data, size);
  const std::size_t family = source.below(families.size());
  std::uint64_t seed = 0;
  while (!source.is_empty()) seed = seed * 257 + source.byte();
  test::Random random(seed);
  for (int n = families[family] == fuzz::test_doubles ? 16 : 1000; n > 0; --n) {
    families[family](random);
  }
  return 0;
}
