// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Balls hold the exact values, which GMP computes with rational numbers.
#include "exact/ball.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "exact/exact_sign.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using exact::Ball;

mpq_class times_power_of_two(const mpq_class& value, int power) {
  mpq_class result;
  if (power >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(power));
  } else {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-power));
  }
  return result;
}

// Takes the highest 53 bits away until nothing is left.
template <std::size_t N>
mpq_class exact_midpoint(const Ball<N>& ball) {
  Ball<N> rest = ball.midpoint();
  mpq_class sum = 0;
  while (rest.sign() != Sign::zero) {
    const double sign = rest.sign() == Sign::positive ? 1 : -1;
    const double bits = sign * static_cast<double>(rest.leading() >> 11U);
    const int power = rest.size_of_midpoint() - 53;
    sum += times_power_of_two(mpq_class(bits), power);
    rest = rest - Ball<N>(bits).times_power_of_two(power);
    EXPECT_TRUE(rest.is_exact());
  }
  return sum;
}

template <std::size_t N>
void expect_inside(const Ball<N>& ball, const mpq_class& value) {
  const mpq_class error = abs(value - exact_midpoint(ball));
  if (ball.is_exact()) {
    EXPECT_EQ(error, 0);
  } else {
    EXPECT_LE(error, times_power_of_two(1, ball.radius()));
  }
  if (ball.sign()) {
    EXPECT_EQ(static_cast<int>(*ball.sign()), sgn(value));
  }
  if (value != 0) {
    EXPECT_LE(abs(value), times_power_of_two(1, ball.size()));
  }
}

double random_double(Random& random) {
  if (random.below(12) == 0) return 0;
  const double digits =
      random.below(3) == 0 ? static_cast<double>(random.between(-9, 9)) : random.signed_unit();
  return std::ldexp(digits, random.coin() ? random.between(-3, 3) : random.between(-200, 200));
}

// Sums, differences and products of what is there; among them differences of equal values.
template <std::size_t N>
void expect_formulas_inside(Random& random) {
  std::vector<Ball<N>> balls;
  std::vector<mpq_class> values;
  for (int i = 0; i < 4; ++i) {
    const double leaf = random_double(random);
    balls.emplace_back(leaf);
    values.emplace_back(leaf);
  }
  for (int step = 0; step < 8; ++step) {
    const std::size_t i = random.below(balls.size());
    const std::size_t j = random.below(balls.size());
    switch (random.below(4)) {
      case 0:
        balls.push_back(balls[i] + balls[j]);
        values.emplace_back(values[i] + values[j]);
        break;
      case 1:
        balls.push_back(balls[i] - balls[j]);
        values.emplace_back(values[i] - values[j]);
        break;
      case 2:
        balls.push_back((balls[i] + balls[j]) - balls[i]);
        values.emplace_back(values[j]);
        break;
      default:
        balls.push_back(balls[i] * balls[j]);
        values.emplace_back(values[i] * values[j]);
    }
    expect_inside(balls.back(), values.back());
  }
}

TEST(balls, hold_sums_and_products) {
  Random random(51);
  for (std::size_t i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    expect_formulas_inside<1>(random);
    expect_formulas_inside<2>(random);
    expect_formulas_inside<5>(random);
  }
}

TEST(balls, are_made_of_all_doubles) {
  using Limits = std::numeric_limits<double>;
  for (const double v : {0.0, -0.0, 1.0, -1.5, Limits::max(), -Limits::min(), Limits::denorm_min(),
                         -3 * Limits::denorm_min(), Limits::min() - Limits::denorm_min()}) {
    expect_inside(Ball<1>(v), v);
    expect_inside(Ball<3>(v), v);
  }
}

// y = 1 / sqrt(a) lies between y - r and y + r, which their squares tell; and r is small.
template <std::size_t N>
void expect_inverse_square_root(const Ball<N>& a, const mpq_class& value) {
  const auto y = exact::inverse_square_root(a);
  ASSERT_TRUE(y);
  const mpq_class middle = exact_midpoint(*y);
  const mpq_class radius = y->is_exact() ? mpq_class(0) : times_power_of_two(1, y->radius());
  const mpq_class below = middle - radius;
  const mpq_class above = middle + radius;
  EXPECT_GT(below, 0);
  EXPECT_LE(below * below * value, 1);
  EXPECT_GE(above * above * value, 1);
  if (a.is_exact()) {
    EXPECT_LE(radius, times_power_of_two(middle, 12 - 64 * static_cast<int>(N)));
  }
}

template <std::size_t N>
void expect_inverse_square_roots(Random& random) {
  const double value = std::ldexp(1 + random.unit(), random.between(-300, 300));
  expect_inverse_square_root(Ball<N>(value), value);
  const double more = std::ldexp(random.unit(), random.between(-300, 300));
  const Ball<N> sum = Ball<N>(value) + Ball<N>(more) * Ball<N>(more);
  expect_inverse_square_root(sum, mpq_class(value) + mpq_class(more) * mpq_class(more));
}

TEST(balls, hold_inverse_square_roots) {
  Random random(52);
  for (std::size_t i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    expect_inverse_square_roots<1>(random);
    expect_inverse_square_roots<2>(random);
    expect_inverse_square_roots<4>(random);
    expect_inverse_square_roots<16>(random);
  }
  EXPECT_FALSE(exact::inverse_square_root(Ball<2>(0.0)));
  EXPECT_FALSE(exact::inverse_square_root(Ball<2>(-4.0)));
  EXPECT_FALSE(exact::inverse_square_root(Ball<2>(1.0).wider_by(-2)));
  expect_inside(*exact::inverse_square_root(Ball<2>(0x1p-600)), times_power_of_two(1, 300));
}

// The capacities that exact_sign.h counts: the largest and the smallest doubles in one formula.
TEST(balls, are_exact_for_cubics_over_the_whole_range) {
  using Limits = std::numeric_limits<double>;
  const Point huge = {Limits::max(), -Limits::max(), Limits::max()};
  const Point tiny = {Limits::denorm_min(), Limits::denorm_min(), -Limits::denorm_min()};
  const Point mixed = {Limits::max(), 3 * Limits::denorm_min(), 1};
  const exact::BallStep<104> step;
  EXPECT_TRUE(det(step(tiny, huge), step(mixed, tiny), step(huge, mixed)).is_exact());
  EXPECT_TRUE(det(step(huge, mixed), step(huge, mixed), step(huge, mixed)).is_exact());
}

// Where the compiler has no type of 128 bits, halves of words are multiplied.
TEST(words, products_by_halves_are_those_of_whole_words) {
  Random random(53);
  const auto word = [&]() -> exact::Word {
    const std::array<exact::Word, 4> some = {0, ~exact::Word{0}, 0xffffffffU, random.next()};
    return some[random.below(4)];
  };
  for (int i = 0; i < 10000; ++i) {
    const exact::Word a = word();
    const exact::Word b = word();
    const exact::Word c = word();
    const exact::Word d = word();
    const exact::TwoWords r = exact::multiply_and_add_halves(a, b, c, d);
    const auto big = [](exact::Word w) {
      return mpz_class(static_cast<unsigned long>(w));  // NOLINT(google-runtime-int): GMP's
    };
    EXPECT_EQ((big(r.high) << 64) + big(r.low), big(a) * big(b) + big(c) + big(d));
    const exact::TwoWords whole = exact::multiply_and_add(a, b, c, d);
    EXPECT_EQ(whole.low, r.low);
    EXPECT_EQ(whole.high, r.high);
  }
}

}  // namespace
}  // namespace rondel::test
