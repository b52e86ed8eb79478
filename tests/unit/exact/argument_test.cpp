// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The argument of a complex number, against MPFR.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "exact/angles.h"
#include "support/mpfr_oracle.h"
#include "support/random.h"

namespace rondel::test {
namespace {

constexpr double huge = std::numeric_limits<double>::max();

// In units of the last place of the result.
double error_of_argument(double y, double x) {
  const double value = exact::argument(y, x);
  mpfr_t exact;
  mpfr_t other;
  mpfr_init2(exact, 200);
  mpfr_init2(other, 53);
  mpfr_set_d(exact, y, MPFR_RNDN);
  mpfr_set_d(other, x, MPFR_RNDN);
  mpfr_atan2(exact, exact, other, MPFR_RNDN);
  mpfr_sub_d(exact, exact, value, MPFR_RNDN);
  const double difference = mpfr_get_d(exact, MPFR_RNDN);
  mpfr_clears(exact, other, static_cast<mpfr_ptr>(nullptr));
  return std::abs(difference) / (std::nextafter(std::abs(value), huge) - std::abs(value));
}

// The table holds arctangents as two doubles each: without the second the error is 1.66.
TEST(argument, is_mostly_within_1_5_ulp_in_all_octants) {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double y = random.signed_unit();
    const double x = random.signed_unit();
    worst = std::max(worst, error_of_argument(y, x));
  }
  RecordProperty("worst_error_in_ulp", std::to_string(worst));
  EXPECT_LE(worst, 1.5);
}

// Where the table's first entry takes over, so that its ulps are larger than those of the result.
TEST(argument, is_within_2_5_ulp_around_a_sixteenth) {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = 1 + std::abs(random.signed_unit());
    worst = std::max(worst, error_of_argument(x * (0.0625 + 1e-4 * random.signed_unit()), x));
  }
  worst = std::max(worst, error_of_argument(0x1.01fa76af6234p-4, 0x1.01b032e8567e7p+0));
  EXPECT_LE(worst, 2.5);
  EXPECT_GT(worst, 2.39);
  EXPECT_LE(error_of_argument(0x1.361070b89f443p-4, 0x1.24e929a5f5e2ap+0), 1.75);
}

TEST(argument, is_precise_for_all_magnitudes) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const double y =
        std::ldexp(random.signed_unit(), static_cast<int>(1020 * random.signed_unit()));
    const double x =
        y * std::ldexp(random.signed_unit(), static_cast<int>(3 * random.signed_unit()));
    if (std::abs(x) > 0) {
      EXPECT_LE(error_of_argument(y, x), 2.5) << y << ' ' << x;
    }
  }
  for (const double y : {huge, 0x1p-1074, 3 * 0x1p-1074, 1.0}) {
    for (const double x : {huge, -huge, 0x1p-1074, -5 * 0x1p-1074, -1.0}) {
      if (y / x != 0 || x < 0) {
        EXPECT_LE(error_of_argument(y, x), 2.5) << y << ' ' << x;
      }
    }
  }
}

TEST(argument, of_axes_and_zeros_is_that_of_the_c_library) {
  for (const double y : {0.0, -0.0, 1.0, -1.0, huge, -huge}) {
    for (const double x : {0.0, 1.0, -1.0, huge, -huge}) {
      EXPECT_EQ(exact::argument(y, x), std::atan2(y, x)) << y << ' ' << x;
      EXPECT_EQ(std::signbit(exact::argument(y, x)), std::signbit(std::atan2(y, x)))
          << y << ' ' << x;
    }
  }
  EXPECT_EQ(exact::argument(0.0, -0.0), 0);  // no cell's area jumps by 4 pi with the sign of a zero
}

TEST(argument, is_odd) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double y = random.signed_unit();
    const double x = random.signed_unit();
    EXPECT_EQ(exact::argument(-y, x), -exact::argument(y, x));
  }
}

}  // namespace
}  // namespace rondel::test
