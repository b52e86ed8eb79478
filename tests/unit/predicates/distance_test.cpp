// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// compare_distance.h and within_angle.h: every rung against sums of roots in GMP and MPFR.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exact/unit_vector.h"
#include "predicates/compare_distance.h"
#include "predicates/within_angle.h"
#include "support/adversarial.h"
#include "support/generators.h"
#include "support/oracle.h"
#include "support/root_sum.h"

namespace rondel::test {
namespace {

using predicates::Cosine;
using predicates::Decision;
using predicates::Rung;

predicates::Vector direction(const Point& p) {
  return exact::to_vector(exact::unit_vector(p, {}).hi);
}

double squared_distance(const Point& a, const Point& b) {
  const predicates::Vector d = direction(a) - direction(b);
  return dot(d, d);
}

// The ladders, of points that are given.

Decision compare_angle(const Point& a, const Point& b, const Point& p, const Point& center = {}) {
  const predicates::FourPoints<Model::projected> points{{a, b, p}, center};
  const auto squared = [&points](Index i) {
    const predicates::Vector d = points.direction(i) - points.direction(2);
    return dot(d, d);
  };
  return predicates::compare_angle(points, 0, squared(0), 1, squared(1), 2);
}

Decision compare_power(const Point& a, const Point& b, const Point& p) {
  const predicates::FourPoints<Model::weighted> points{{a, b, p}};
  return predicates::compare_power(points, 0, 1, 2);
}

Decision is_within_angle(const Point& a, const Point& p, const Cosine& cosine) {
  const predicates::FourPoints<Model::projected> points{{a, p}};
  return predicates::is_within_angle(points, 0, 1, cosine);
}

Decision is_within_power(const Point& a, const Point& p, const Cosine& cosine,
                         const Sphere& sphere) {
  const predicates::FourPoints<Model::weighted> points{{a, p}, sphere.center};
  return predicates::is_within_power(points, 0, 1, cosine, sphere.squared_radius);
}

// p.a |b| - p.b |a|, all three scaled to integers.
int angle_sign(const Point& a, const Point& b, const Point& p) {
  const Point all[] = {a, b, p};
  const Oracle oracle(all, Model::projected, {});
  RootSum sum;
  sum.squares = {dot(oracle.vector(0), oracle.vector(0)), dot(oracle.vector(1), oracle.vector(1)),
                 1, 1};
  sum.c[2] = dot(oracle.vector(2), oracle.vector(0));
  sum.c[1] = -dot(oracle.vector(2), oracle.vector(1));
  return sign(sum);
}

int power_sign(const Point& a, const Point& b, const Point& p) {
  const Point all[] = {a, b, p};
  const Oracle oracle(all, Model::weighted, {});
  return sgn(
      mpz_class(dot(oracle.vector(2), oracle.vector(0)) - dot(oracle.vector(2), oracle.vector(1))));
}

// p.a - c |p| |a| with c = 1 - t/2 or its negative.
int within_sign(const Point& a, const Point& p, const Cosine& cosine) {
  const Point all[] = {a, p};
  const Oracle oracle(all, Model::projected, {});
  mpq_class c = 1 - mpq_class(cosine.t) / 2;
  if (!cosine.is_positive) c = -c;
  RootSum sum;
  sum.squares = {dot(oracle.vector(0), oracle.vector(0)) * dot(oracle.vector(1), oracle.vector(1)),
                 1, 1, 1};
  sum.c[0] = dot(oracle.vector(0), oracle.vector(1)) * c.get_den();
  sum.c[1] = -c.get_num();
  return sign(sum);
}

class distance_rungs : public testing::TestWithParam<FourGenerator> {};

TEST_P(distance_rungs, never_give_a_wrong_sign) {
  Random random(51);
  for (std::size_t i = 0; i < scaled(1500) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    const auto& [a, b, c, p] = four;
    const int angle = angle_sign(a, b, p);
    const Sign filter =
        predicates::compare_angle_filter(squared_distance(a, p), squared_distance(b, p));
    if (filter != Sign::zero) {
      EXPECT_EQ(to_int(filter), angle);
    }
    const Sign close = predicates::compare_angle_double_double(
        exact::unit_vector(a, {}), exact::unit_vector(b, {}), exact::unit_vector(p, {}));
    if (close != Sign::zero) {
      EXPECT_EQ(to_int(close), angle);
    }
    EXPECT_EQ(to_int(predicates::compare_angle_exact(a, b, p, {})), angle);
    const Decision decision = compare_angle(a, b, p);
    EXPECT_EQ(to_int(decision.sign), angle);
    EXPECT_EQ(to_int(compare_angle(b, a, p).sign), -angle);
    const Point twice = 2 * p;
    if (std::isfinite(twice.x + twice.y + twice.z)) {
      EXPECT_EQ(to_int(compare_angle(a, b, twice).sign), angle);
    }
    if (angle == 0) {
      EXPECT_EQ(decision.rung, Rung::exact);
    }

    const int power = power_sign(a, b, p);
    using exact::to_vector;
    const Sign power_filter =
        predicates::compare_power_filter(to_vector(a), to_vector(b), to_vector(p));
    if (power_filter != Sign::zero) {
      EXPECT_EQ(to_int(power_filter), power);
    }
    EXPECT_EQ(to_int(predicates::compare_power_exact(a, b, p, {})), power);
    EXPECT_EQ(to_int(compare_power(a, b, p).sign), power);
  }
}

// Thresholds next to the distance, where nothing but the last rung can decide.
TEST_P(distance_rungs, decide_on_the_boundary_of_an_angle) {
  Random random(52);
  for (std::size_t i = 0; i < scaled(700) && !HasFailure(); ++i) {
    const Four four = GetParam().make(random);
    const auto& [a, b, c, p] = four;
    const bool is_positive = random.coin();
    const double d2 = squared_distance(a, is_positive ? p : -1 * p);
    for (const double t : {d2, std::nextafter(d2, 2), 1.001 * d2, 0.999 * d2, 2.0, 0.0}) {
      if (t > 2) continue;
      const Cosine cosine{is_positive, t};
      const int expected = within_sign(a, p, cosine);
      const Sign filter = predicates::is_within_angle_filter(direction(a), direction(p), cosine);
      if (filter != Sign::zero) {
        EXPECT_EQ(to_int(filter), expected);
      }
      const Sign close = predicates::is_within_angle_double_double(
          exact::unit_vector(a, {}), exact::unit_vector(p, {}), cosine);
      if (close != Sign::zero) {
        EXPECT_EQ(to_int(close), expected);
      }
      EXPECT_EQ(to_int(predicates::is_within_angle_exact(a, p, cosine, {})), expected);
      EXPECT_EQ(to_int(is_within_angle(a, p, cosine).sign), expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(generators, distance_rungs, testing::ValuesIn(four_generators()),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(compare_distance, decides_easy_comparisons_by_the_filter) {
  Random random(53);
  std::size_t unsure = 0;
  for (int i = 0; i < 1000; ++i) {
    const Point p = random_direction(random);
    const double a = squared_distance(random_near(random, p, 1e-6), p);
    const double b = squared_distance(random_near(random, p, 1e-6), p);
    if (predicates::compare_angle_filter(a, b) == Sign::zero) ++unsure;
  }
  EXPECT_LE(unsure, 5U);
}

TEST(compare_distance, decides_close_comparisons_in_double_double) {
  const Point p = {1, 0, 0};
  const Point a = {1, 1e-9, 0};
  const Point b = {1, 0, std::nextafter(1e-9, 1)};
  EXPECT_EQ(predicates::compare_angle_filter(squared_distance(a, p), squared_distance(b, p)),
            Sign::zero);
  const Decision decision = compare_angle(a, b, p);
  EXPECT_EQ(decision.sign, Sign::positive);
  EXPECT_EQ(decision.rung, Rung::double_double);
}

// Sites of equal and of different lengths, with and without a center.
TEST(compare_distance, finds_ties) {
  const auto tie = [](const Point& a, const Point& b, const Point& p, const Point& center) {
    const Decision decision = compare_angle(a, b, p, center);
    EXPECT_EQ(decision.sign, Sign::zero);
    EXPECT_EQ(decision.rung, Rung::exact);
  };
  tie({0.1, 0.2, 0.3}, {0.1, 0.2, -0.3}, {0.7, 0.4, 0}, {});
  tie({1, 1, 0}, {3, 0, 3}, {1, 0, 0}, {});
  tie({1e-200, 1e-200, 0}, {3e200, 0, 3e200}, {1, 0, 0}, {});
  tie({1, 0, 0}, {0, 5, 0}, {0, 0, 1}, {});
  tie({2, 3, 5}, {3, 2, 7}, {2, 2, 5}, {1, 2, 5});
  EXPECT_EQ(compare_power({1, 1, 0}, {1, 0, 7}, {3, 0, 0}).sign, Sign::zero);
  EXPECT_EQ(compare_power({1e300, 1, 0}, {1e300, 0, 7}, {1e-300, 0, 0}).sign, Sign::zero);
}

TEST(within_angle, cosines_are_accurate) {
  constexpr double pi = std::numbers::pi;
  for (const double angle : {1e-100, 1e-12, 0.01, 1.0, pi / 3, pi / 2, 2.0, 3.14159}) {
    const Cosine cosine = predicates::cosine_of(angle);
    EXPECT_EQ(cosine.is_positive, angle <= pi / 2);
    const double half = std::sin((cosine.is_positive ? angle : pi - angle) / 2);
    EXPECT_NEAR(cosine.t / (4 * half * half), 1, 1e-15) << angle;
  }
  EXPECT_EQ(predicates::cosine_of(0).t, 0);
}

// 60 degrees between (1,1,0) and (1,0,1): c = 1/2 and t = 1 are exact.
TEST(within_angle, has_its_boundary) {
  const Cosine sixty{true, 1};
  const Decision decision = is_within_angle({1, 1, 0}, {1, 0, 1}, sixty);
  EXPECT_EQ(decision.sign, Sign::zero);
  EXPECT_EQ(decision.rung, Rung::exact);
  const Cosine opposite{false, 1};
  EXPECT_EQ(is_within_angle({1, 1, 0}, {-1, 0, -1}, opposite).sign, Sign::zero);
  // A circle of 60 degrees around the x axis: its pole is 1 / cos 60 = 2 away.
  const Sphere sphere{{1, 1, 1}, 4};
  const Point pole = {1 + 4, 1, 1};
  EXPECT_EQ(is_within_power(pole, {2, 1, 1}, {true, 0}, sphere).rung, Rung::filter);
  EXPECT_EQ(is_within_power({1, 1, 3}, {1, 1, 9}, {true, 0}, sphere).sign, Sign::zero);
  EXPECT_EQ(is_within_power({1, 1, 3}, {1, 2, 1}, {true, 2}, sphere).sign, Sign::zero);
}

}  // namespace
}  // namespace rondel::test
