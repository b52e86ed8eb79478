// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// polar_point: circles become weighted sites.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <limits>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// How far `value` is from numerator / cos(radius), in ulp.
double error_in_ulp(double value, double numerator, double radius_deg) {
  mpfr_t exact;
  mpfr_init2(exact, 300);
  mpfr_const_pi(exact, MPFR_RNDN);
  mpfr_mul_d(exact, exact, radius_deg, MPFR_RNDN);
  mpfr_div_ui(exact, exact, 180, MPFR_RNDN);
  mpfr_cos(exact, exact, MPFR_RNDN);
  mpfr_d_div(exact, numerator, exact, MPFR_RNDN);
  mpfr_sub_d(exact, exact, value, MPFR_RNDN);
  const double error = mpfr_get_d(exact, MPFR_RNDN);
  mpfr_clear(exact);
  return std::abs(error) / (std::nextafter(std::abs(value), infinity) - std::abs(value));
}

TEST(polar_point, of_radius_zero_is_the_center_bit_for_bit) {
  Random random(1);
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  for (int i = 0; i < 1000; ++i) {
    const Point q = i == 0 ? Point{-0.0, 1e-310, -1} : 6371 * random_direction(random);
    const Point p = polar_point(q, 0);
    ASSERT_EQ(bits(p.x), bits(q.x));
    ASSERT_EQ(bits(p.y), bits(q.y));
    ASSERT_EQ(bits(p.z), bits(q.z));
  }
  EXPECT_EQ(polar_point(LonLat{12.5, -30}, 0), unit_vector({12.5, -30}));
}

TEST(polar_point, is_within_two_ulp_up_to_the_last_radius) {
  Random random(2);
  double worst = 0;
  const auto measure = [&](const Point& q, double radius_deg) {
    const Point p = polar_point(q, radius_deg);
    worst = std::max({worst, error_in_ulp(p.x, q.x, radius_deg), error_in_ulp(p.y, q.y, radius_deg),
                      error_in_ulp(p.z, q.z, radius_deg)});
  };
  for (int i = 0; i < 20000; ++i) {
    const double radius_deg = i % 2 == 0 ? 90 * random.unit() : 90 - 90 * std::exp2(-i % 45);
    measure(random_direction(random), radius_deg);
  }
  measure(random_direction(random), std::nextafter(90.0, 0.0));
  measure(random_direction(random), 1e-300);
  RecordProperty("worst_error_in_ulp", std::to_string(worst));
  EXPECT_LE(worst, 2.0);
  EXPECT_GT(polar_point(Point{0, 0, 1}, std::nextafter(90.0, 0.0)).z, 4e15);
}

// 60 degrees is no double in radians: degrees are reduced exactly.
TEST(polar_point, gives_the_same_for_both_kinds_of_center) {
  for (const double radius_deg : {0.0, 1e-9, 30.0, 60.0, 89.9999}) {
    const LonLat center{-74.01, 40.71};
    EXPECT_EQ(polar_point(center, radius_deg), polar_point(unit_vector(center), radius_deg));
    EXPECT_EQ(polar_points(std::vector{center}, std::vector{radius_deg}),
              std::vector{polar_point(center, radius_deg)});
  }
}

TEST(polar_point, refuses_radii_of_no_circle) {
  for (const double bad : {-1e-300, -5.0, 90.0, 95.0, nan, infinity, -infinity}) {
    EXPECT_THROW(polar_point(Point{1, 0, 0}, bad), InvalidInput) << bad;
    EXPECT_THROW(polar_point(LonLat{0, 0}, bad), InvalidInput) << bad;
  }
}

template <class Center>
void expect_invalid(const std::vector<Center>& centers, const std::vector<double>& radii_deg,
                    std::size_t index, const std::string& text) {
  try {
    polar_points(centers, radii_deg);
    FAIL() << "accepted: " << text;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_EQ(error.what(), text);
  }
}

TEST(polar_points, name_the_first_bad_index) {
  const std::vector<Point> points(4, Point{1, 0, 0});
  std::vector<LonLat> positions(4);
  expect_invalid(points, {0, 10, 90, -1}, 2, "site 2: radius 90 is not in [0, 90)");
  expect_invalid(positions, {0, nan, 95, 0}, 1, "site 1: radius nan is not in [0, 90)");
  expect_invalid(points, {0, -0.5, 95, 0}, 1, "site 1: radius -0.5 is not in [0, 90)");
  expect_invalid(points, {0, 1, 2}, 3, "3 radii for 4 centers");
  positions[3].lat_deg = 91;
  expect_invalid(positions, {0, 1, 2, 3}, 3, "site 3: latitude 91 is outside [-90, 90]");
  EXPECT_TRUE(polar_points(std::vector<Point>{}, {}).empty());
}

}  // namespace
}  // namespace rondel::test
