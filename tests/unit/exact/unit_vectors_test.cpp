// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Unit vectors of many sites, and what the projected model makes of them.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "exact/integer_signs.h"
#include "exact/unit_vector.h"
#include "models/projected_points.h"
#include "predicates/conflict.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {
namespace {

// Bit for bit those of single points, for which predicates/bounds_test.cpp has an oracle.
void expect_unit_vectors(const std::vector<Point>& sites, const Point& center) {
  std::vector<Index> order(sites.size());
  std::iota(order.rbegin(), order.rend(), Index{0});
  std::vector<exact::SplitPoint> units(sites.size());
  exact::unit_vectors(sites, order, center, units.data());
  for (std::size_t k = 0; k < units.size(); ++k) {
    const exact::SplitPoint u = exact::unit_vector(sites[order[k]], center);
    EXPECT_EQ(units[k].hi, u.hi) << k;
    EXPECT_EQ(units[k].lo, u.lo) << k;
  }
}

TEST(unit_vectors, are_those_of_single_points) {
  for (const char* name : {"uniform", "patch_1e_9", "near_sphere", "mixed_scales", "s_n"}) {
    expect_unit_vectors(generator(name).make(700, 1).sites, {});
    expect_unit_vectors(generator(name).make(65, 2).sites, {1e-3, 7, -0.1});
  }
}

TEST(unit_vectors, hold_where_squares_would_leave_the_range) {
  std::vector<Point> sites;
  for (int exponent = -1070; exponent < 1020; exponent += 10) {
    sites.push_back({std::ldexp(1.25, exponent), std::ldexp(-0.75, exponent), 0});
  }
  expect_unit_vectors(sites, {});
}

// Many ties on one circle around the z axis, so that first some low parts are computed one by one
// and then all at once. The poles have none: their directions are exact.
TEST(unit_vectors, decide_ties_alike_one_by_one_and_all_at_once) {
  Random random(7);
  const Point center = {0.25, -2, 1e-3};
  std::vector<Point> sites = {center + Point{0, 0, 1}, center + Point{0, 0, -1}};
  while (sites.size() < 200) {
    const double angle = 6.28 * random.unit();
    sites.push_back(center + Point{0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.8});
  }
  std::vector<Index> order(sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  models::ProjectedPoints all(sites, order, center);
  for (int i = 0; i < 2000; ++i) {
    std::array<Index, 4> four{};
    for (Index& k : four) k = static_cast<Index>(random.below(sites.size()));
    const auto [a, b, c, p] = four;
    if (a == b || a == c || a == p || b == c || b == p || c == p) continue;
    models::ProjectedPoints few(sites, four, center);
    const Sign sign = rondel::predicates::conflict(few, 0, 1, 2, 3).sign;
    EXPECT_EQ(rondel::predicates::conflict(all, a, b, c, p).sign, sign) << i;
    EXPECT_EQ(rondel::predicates::conflict_above_filter(all, a, b, c, p).sign, sign) << i;
  }
}

// Sites that came after the first low part was computed have room for theirs when all are found.
TEST(unit_vectors, decide_ties_of_sites_that_came_later) {
  Random random(8);
  std::vector<Point> sites;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 6.28 * random.unit();
    sites.push_back({0.6 * std::cos(angle), 0.6 * std::sin(angle), 0.8});
  }
  std::vector<Index> order(sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  models::ProjectedPoints all(sites, order, {});
  const std::size_t few = 600;
  models::ProjectedPoints growing(sites, std::span(order).first(few), {});
  const auto is_alike = [&](Index p) {
    return rondel::predicates::conflict_above_filter(growing, 0, 1, 2, p).sign ==
           rondel::predicates::conflict_above_filter(all, 0, 1, 2, p).sign;
  };
  EXPECT_TRUE(is_alike(3));
  for (Index p = few; p < sites.size(); ++p) growing.set(p, sites, order);
  for (Index p = 3; p < few; ++p) EXPECT_TRUE(is_alike(p)) << p;
}

// Signs of determinants in integers of the machine, which GMP computes with rational numbers.

using Corners = std::array<Point, 4>;  // o, a, b, c

std::optional<Sign> volume_in_integers(const Corners& q) {
  return exact::sign_of_volume_in_integers(q[0], q[1], q[2], q[3]);
}

int sign_by_gmp(const Corners& q) {
  std::array<std::array<mpq_class, 3>, 3> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {mpq_class(q[i + 1].x) - mpq_class(q[0].x), mpq_class(q[i + 1].y) - mpq_class(q[0].y),
            mpq_class(q[i + 1].z) - mpq_class(q[0].z)};
  }
  const mpq_class value = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
                          v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
                          v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  return sgn(value);
}

// Whether the compiler has the integers that it takes.
bool is_available() { return volume_in_integers({}).has_value(); }

// Returns whether the integers know.
bool expect_no_other_sign(const Corners& q) {
  const std::optional<Sign> sign = volume_in_integers(q);
  if (sign) {
    EXPECT_EQ(static_cast<int>(*sign), sign_by_gmp(q));
  }
  return sign.has_value();
}

TEST(integer_steps, know_the_signs_of_neighbors_in_a_mesh) {
  Random random(1);
  std::size_t known = 0;
  for (int i = 0; i < 2000; ++i) {
    Corners q;
    q[0] = random_direction(random);
    for (std::size_t k = 1; k < 4; ++k) q[k] = random_near(random, q[0], std::ldexp(1, -(i % 50)));
    if (expect_no_other_sign(q)) ++known;
    // In one plane with the last three, bit for bit.
    for (Point& p : q) p.x = p.y;
    EXPECT_EQ(volume_in_integers(q).value_or(Sign::zero), Sign::zero);
  }
  EXPECT_TRUE(known > 1500 || !is_available());
}

// Every product and sum that may come close to the ends of the range does.
TEST(integer_steps, do_not_overflow_at_the_longest_coordinates) {
  const double most = 0x1p60 - 0x1p7;
  Random random(2);
  for (int power : {0, -700, 900}) {
    for (int i = 0; i < 4096; ++i) {
      Corners q;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto corner = [&](std::size_t axis) {
          const double end = (static_cast<unsigned>(i) >> (3 * k + axis) & 1U) == 0 ? -most : most;
          const auto step = static_cast<double>(random.below(3)) * (end < 0 ? 0x1p7 : -0x1p7);
          return std::ldexp(end + step, power);
        };
        q[k] = {corner(0), corner(1), corner(2)};
      }
      ASSERT_TRUE(expect_no_other_sign(q) || !is_available());
    }
  }
}

// The determinant is 1, -1 or 0 next to products of 2^180.
TEST(integer_steps, see_the_last_bit) {
  constexpr double n = 0x1p52;
  for (const double off : {-1.0, 0.0, 1.0}) {
    // det of rows (n, n+1, 0), (n-1, n, 0), (0, 0, off) is off.
    const Corners q = {{{0, 0, 0}, {n, n + 1, 0}, {n - 1, n, 0}, {n, n, off}}};
    EXPECT_EQ(sign_by_gmp(q), static_cast<int>(off));
    EXPECT_TRUE(expect_no_other_sign(q) || !is_available());
  }
}

TEST(integer_steps, know_what_is_a_multiple_of_one_unit_below_60_bits) {
  if (!is_available()) GTEST_SKIP() << "no integers of 128 bits";
  const auto with = [](double longest, double other) {
    return Corners{{{longest, 0, 0}, {other, 1, 0}, {0, 0, 1}, {0, 1, 1}}};
  };
  EXPECT_TRUE(expect_no_other_sign(with(0x1p59, 1)));
  EXPECT_TRUE(expect_no_other_sign(with(0x1p60 - 0x1p7, 1)));
  EXPECT_FALSE(volume_in_integers(with(0x1p59, 0.5)));
  EXPECT_FALSE(volume_in_integers(with(0x1p60, 1)));
  // What becomes 0 next to it in any unit.
  EXPECT_FALSE(volume_in_integers(with(0x1p1000, 0x1p-900)));
  EXPECT_FALSE(volume_in_integers(with(-0x1p60, 1 + 0x1p-52)));
}

// An axis along which all are 0 is one; a unit must be a number that a power of two reaches.
TEST(integer_steps, know_zeros_and_large_coordinates_but_no_tiny_ones) {
  if (!is_available()) GTEST_SKIP() << "no integers of 128 bits";
  EXPECT_EQ(volume_in_integers({{{1, 0, 0}, {0, 1, 0}, {-1, 0.5, -0.0}, {3, 4, 0}}}), Sign::zero);
  const auto scaled = [](double size) {
    return Corners{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}};
  };
  for (const double size : {0x1p-963, 1.0, std::numeric_limits<double>::max()}) {
    EXPECT_EQ(volume_in_integers(scaled(size)), Sign::positive);
  }
  for (const double size : {0x1p-964, 0x1p-1022, std::numeric_limits<double>::denorm_min()}) {
    EXPECT_FALSE(volume_in_integers(scaled(size)));
  }
}

}  // namespace
}  // namespace rondel::test
