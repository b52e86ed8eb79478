// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Unit vectors of many sites, and what the projected model makes of them.
#include "exact/unit_vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "models/projected_points.h"
#include "predicates/conflict.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel::test {
namespace {

// Bit for bit those of single points, for which predicates_bounds_test.cpp has an oracle.
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

}  // namespace
}  // namespace rondel::test
