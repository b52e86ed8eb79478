// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The arithmetic below the predicates, against MPFR and integers.

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "exact/angles.h"
#include "exact/integer.h"
#include "exact/unit_vector.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel {
namespace {

constexpr mpfr_prec_t bits = 6000;  // squares of doubles from 2^-1074 to 2^1024, and their sums

struct Number {
  mpfr_t value;
  Number() { mpfr_init2(value, bits); }
  explicit Number(double v) : Number() { mpfr_set_d(value, v, MPFR_RNDN); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  ~Number() { mpfr_clear(value); }
};

double ulp(double v) {
  return std::nextafter(std::abs(v), std::numeric_limits<double>::infinity()) - std::abs(v);
}

// value - exact, in doubles.
double error_of(double value, const Number& exact) {
  Number difference(value);
  mpfr_sub(difference.value, difference.value, exact.value, MPFR_RNDN);
  return mpfr_get_d(difference.value, MPFR_RNDN);
}

void expect_unit_vector(const Point& p, const Point& center) {
  const std::array<double, 3> from = {p.x, p.y, p.z};
  const std::array<double, 3> to = {center.x, center.y, center.z};
  std::array<Number, 3> d;
  Number length(0);
  Number square;
  for (std::size_t i = 0; i < 3; ++i) {
    mpfr_set_d(d[i].value, from[i], MPFR_RNDN);
    mpfr_sub_d(d[i].value, d[i].value, to[i], MPFR_RNDN);
    mpfr_sqr(square.value, d[i].value, MPFR_RNDN);
    mpfr_add(length.value, length.value, square.value, MPFR_RNDN);
  }
  mpfr_sqrt(length.value, length.value, MPFR_RNDN);
  const exact::SplitPoint u = exact::unit_vector(p, center);
  const std::array<double, 3> hi = {u.hi.x, u.hi.y, u.hi.z};
  const std::array<double, 3> lo = {u.lo.x, u.lo.y, u.lo.z};
  double squared_error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    mpfr_div(d[i].value, d[i].value, length.value, MPFR_RNDN);
    const double most = std::abs(hi[i]) < 0x1p-1010 ? 0x1p-1073 : 0.51 * ulp(hi[i]);
    EXPECT_LE(std::abs(error_of(hi[i], d[i])), most) << p.x << " " << p.y << " " << p.z;
    mpfr_sub_d(d[i].value, d[i].value, hi[i], MPFR_RNDN);
    const double error = error_of(lo[i], d[i]);
    squared_error += error * error;
  }
  EXPECT_LE(std::sqrt(squared_error), 0x1p-100) << p.x << " " << p.y << " " << p.z;
}

TEST(exact_unit_vector, is_as_precise_as_stated) {
  test::Random random(1);
  const auto coordinate = [&random] { return random.signed_unit(); };
  for (int i = 0; i < 2000; ++i) {
    expect_unit_vector({coordinate(), coordinate(), coordinate()}, {});
    expect_unit_vector({coordinate(), coordinate(), coordinate()},
                       {coordinate(), coordinate(), coordinate()});
    expect_unit_vector({1e6 + coordinate(), -3, coordinate()}, {1e6, -3, 0.1});
  }
}

TEST(exact_unit_vector, holds_at_the_ends_of_the_range) {
  constexpr double huge = std::numeric_limits<double>::max();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  expect_unit_vector({huge, huge, -huge}, {});
  expect_unit_vector({tiny, 0, 2 * tiny}, {});
  expect_unit_vector({huge, 1, tiny}, {-huge, 0, 0});
  expect_unit_vector({huge, tiny, 0}, {huge, 0, 0});
  expect_unit_vector({1, 1 + 0x1p-52, 0}, {1, 1, 0});
  expect_unit_vector({1e-300, 2e-300, 3e-300}, {0, 1e-300, 0});
  // Small coordinates beside large ones: their low parts underflow.
  expect_unit_vector({0x1.fa72408b5d1d9p+0, -0x1.5bb3f9bad96c7p+0, -0x0.ee79b9cbcf9cp-1022}, {});
  expect_unit_vector({-0x1.2b6c7147b25edp-319, 0x1.8446f382f51a1p+855, 0x1.33ce246f7213cp-216}, {});
  expect_unit_vector({-0x0.00000348c6514p-1022, 0x1.22d9424a747e8p-22, -0x1.00000676ca90fp-3},
                     {0x1.ff6c56a6cccacp-1013, -0x1.000000000000cp+9, 0x1p+3});
}

TEST(exact_degrees, sine_and_cosine_are_within_the_stated_error) {
  test::Random random(2);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double degrees = (i % 2 != 0 ? 720 : 90) * (random.signed_unit());
    const auto value = exact::sine_cosine_of_degrees(degrees);
    Number angle;
    Number sine;
    Number cosine;
    mpfr_const_pi(angle.value, MPFR_RNDN);
    mpfr_mul_d(angle.value, angle.value, degrees, MPFR_RNDN);
    mpfr_div_ui(angle.value, angle.value, 180, MPFR_RNDN);
    mpfr_set_prec(sine.value, 300);
    mpfr_set_prec(cosine.value, 300);
    mpfr_prec_round(angle.value, 300, MPFR_RNDN);
    mpfr_sin_cos(sine.value, cosine.value, angle.value, MPFR_RNDN);
    worst = std::max({worst, std::abs(error_of(value.sine, sine)) / ulp(value.sine),
                      std::abs(error_of(value.cosine, cosine)) / ulp(value.cosine)});
  }
  RecordProperty("worst_error_in_ulp", std::to_string(worst));
  EXPECT_LE(worst, 1.0);
}

TEST(exact_degrees, quadrants_are_exact_and_zeros_positive) {
  EXPECT_EQ(unit_vector({90, 0}), (Point{0, 1, 0}));
  EXPECT_FALSE(std::signbit(unit_vector({90, 0}).x));
  EXPECT_FALSE(std::signbit(unit_vector({-180, 0}).y));
  for (const double lon : {-180.0, 0.0, 17.3, 90.0, 359.0}) {
    EXPECT_EQ(unit_vector({lon, 90}), (Point{0, 0, 1})) << lon;
    EXPECT_EQ(unit_vector({lon, -90}), (Point{0, 0, -1})) << lon;
  }
  for (const double lat : {-33.3, 0.0, 45.0, 71.25}) {
    EXPECT_EQ(unit_vector({-180, lat}), unit_vector({180, lat}));
    EXPECT_EQ(unit_vector({180, lat}), unit_vector({540, lat}));
    EXPECT_EQ(unit_vector({-12.5, lat}), unit_vector({347.5, lat}));
    const Point east = unit_vector({12.5, lat});
    EXPECT_EQ(unit_vector({-12.5, lat}), (Point{east.x, -east.y, east.z}));
  }
}

// Of numbers of any length; those next to squares are the hardest.
TEST(exact_floor_sqrt, is_the_largest_integer_with_no_larger_square) {
  using exact::Integer;
  test::Random random(4);
  const auto expect_floor = [](const Integer& n) {
    const Integer root = exact::floor_sqrt(n);
    EXPECT_LE(root * root, n);
    EXPECT_GT((root + 1) * (root + 1), n);
  };
  for (int n = 0; n < 300; ++n) expect_floor(n);
  for (int i = 0; i < 2000; ++i) {
    Integer root = 0;
    for (std::size_t word = 1 + random.below(40); word > 0; --word) {
      const std::uint64_t word_bits = random.below(3) == 0 ? ~std::uint64_t{0} : random.next();
      root = (root << 32U) + static_cast<std::int64_t>(word_bits >> 32U);
      root = (root << 32U) + static_cast<std::int64_t>(word_bits & 0xffffffffU);
    }
    root = root >> static_cast<unsigned>(random.below(64));
    if (random.below(4) == 0) root = Integer(1) << static_cast<unsigned>(random.below(2000));
    for (int step = -2; step <= 2; ++step) {
      if (root > 1) expect_floor(root * root + step);
    }
    expect_floor(root * root + root);
    expect_floor(root * root + 2 * root);
    expect_floor(root);
  }
}

TEST(exact_root_sum, finds_zeros_and_signs_next_to_zero) {
  using exact::Integer;
  const auto sign = [](std::array<Integer, 3> c, std::array<Integer, 3> r) {
    return exact::sign_of_root_sum(c, r);
  };
  // sqrt(8) = 2 sqrt(2), sqrt(18) = 3 sqrt(2).
  EXPECT_EQ(sign({1, 1, -5}, {8, 18, 2}), Sign::zero);
  EXPECT_EQ(sign({1, 1, -1}, {8, 18, 50}), Sign::zero);
  EXPECT_EQ(sign({1, 1, -1}, {2, 3, 10}), Sign::negative);
  // The same with radicands of 400 bits, and one off by 1 in its last bit.
  const Integer big = (Integer(1) << 199) + 12345;
  EXPECT_EQ(sign({1, 1, -5}, {8 * big * big, 18 * big * big, 2 * big * big}), Sign::zero);
  EXPECT_EQ(sign({1, 1, -5}, {8 * big * big, 18 * big * big + 1, 2 * big * big}), Sign::positive);
  EXPECT_EQ(sign({1, 1, -5}, {8 * big * big - 1, 18 * big * big, 2 * big * big}), Sign::negative);
  // a^2 + 1 against a: a difference of 2^-300.
  const Integer a = Integer(1) << 300;
  EXPECT_EQ(sign({1, -a, 0}, {a * a + 1, 1, 1}), Sign::positive);
  EXPECT_EQ(sign({1, -a, 0}, {a * a, 1, 1}), Sign::zero);
}

TEST(exact_root_sum, agrees_with_squares_on_all_small_cases) {
  for (int r = 1; r < 130; ++r) {
    for (int s = 1; s < 130; ++s) {
      for (int c = 1; c < 4; ++c) {
        const std::array<exact::Integer, 2> coefficients = {c, -2};
        const std::array<exact::Integer, 2> radicands = {r, s};
        const int difference = c * c * r - 4 * s;
        EXPECT_EQ(static_cast<int>(exact::sign_of_root_sum(coefficients, radicands)),
                  (difference > 0) - (difference < 0));
      }
    }
  }
}

}  // namespace
}  // namespace rondel
