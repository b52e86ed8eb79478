// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integers of any size beside those of GMP.
#include "exact/big_integer.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "exact/integer.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using exact::Integer;

// A number of up to `size` words with its value in GMP. Words of zeros and of ones are frequent:
// carries run through them, and the guessed digits of a division are wrong there.
std::pair<Integer, mpz_class> any_integer(Random& random, std::size_t size) {
  Integer number;
  mpz_class expected;
  for (std::size_t i = random.below(size + 1); i-- > 0;) {
    std::uint64_t word = random.below(std::numeric_limits<std::uint32_t>::max());
    word = word << 32U | random.below(std::numeric_limits<std::uint32_t>::max());
    const std::array<std::uint64_t, 6> words = {
        word, word, 0, ~std::uint64_t{0}, 1, std::uint64_t{0xffffffff} << (random.below(2) * 32)};
    word = words[random.below(words.size())];
    // A half has a sign of its own, so that constructors see all of them.
    number = (number << 64) + (Integer(static_cast<std::int64_t>(word >> 1U)) << 1) +
             Integer(static_cast<std::int64_t>(word & 1U));
    expected = (expected << 64) + mpz_class(static_cast<unsigned long>(word));
  }
  if (random.below(2) == 0) return {-number, -expected};
  return {number, expected};
}

// The value, word by word.
mpz_class value_of(const Integer& number) {
  mpz_class value;
  for (unsigned bits = (number.num_bits() + 63) / 64; bits-- > 0;) {
    value =
        (value << 64) + mpz_class(static_cast<unsigned long>((number >> (64 * bits)).low_word()));
  }
  return number.sign() < 0 ? mpz_class(-value) : value;
}

TEST(big_integer, computes_what_gmp_computes) {
  Random random(1);
  for (unsigned i = 0; i < 20'000; ++i) {
    const auto [a, x] = any_integer(random, 6);
    const auto [b, y] = any_integer(random, 6);
    ASSERT_EQ(value_of(a), x);
    ASSERT_EQ(value_of(a + b), x + y) << x << ' ' << y;
    ASSERT_EQ(value_of(a - b), x - y) << x << ' ' << y;
    ASSERT_EQ(value_of(a * b), x * y) << x << ' ' << y;
    ASSERT_EQ(value_of(abs(a)), abs(x));
    ASSERT_EQ(a.sign(), sgn(x));
    ASSERT_EQ(a < b, x < y);
    ASSERT_EQ(a == b, x == y);
    if (y == 0) continue;
    const auto [quotient, remainder] = divide(a, b);
    ASSERT_EQ(value_of(quotient), x / y) << x << ' ' << y;
    ASSERT_EQ(value_of(remainder), x % y) << x << ' ' << y;
  }
}

TEST(big_integer, shifts_and_counts_bits_as_gmp_does) {
  Random random(2);
  for (unsigned i = 0; i < 5'000; ++i) {
    const auto [a, x] = any_integer(random, 4);
    const auto bits = static_cast<unsigned>(random.below(300));
    mpz_class shifted = abs(x) >> bits;  // GMP rounds negative numbers down
    if (x < 0) shifted = -shifted;
    mpz_class lowest;
    mpz_fdiv_r_2exp(lowest.get_mpz_t(), mpz_class(abs(x)).get_mpz_t(), bits);
    ASSERT_EQ(value_of(a << bits), mpz_class(x << bits));
    ASSERT_EQ(value_of(a >> bits), shifted);
    ASSERT_EQ(value_of(low_bits(a, bits)), lowest);
    if (x == 0) {
      ASSERT_EQ(a.num_bits(), 0U);
      continue;
    }
    ASSERT_EQ(a.num_bits(), mpz_sizeinbase(x.get_mpz_t(), 2));
    ASSERT_EQ(a.trailing_zeros(), mpz_scan1(x.get_mpz_t(), 0));
  }
}

TEST(big_integer, takes_roots_as_gmp_does) {
  Random random(3);
  for (unsigned i = 0; i < 5'000; ++i) {
    auto [a, x] = any_integer(random, 8);
    if (i % 2 == 0) {  // squares, and their neighbors
      const auto step = static_cast<std::int64_t>(random.below(3)) - 1;
      a = a * a + Integer(step);
      x = x * x + static_cast<long>(step);
    }
    ASSERT_EQ(value_of(exact::floor_sqrt(abs(a))), sqrt(mpz_class(abs(x)))) << x;
  }
}

TEST(big_integer, starts_from_every_integer_of_a_machine) {
  constexpr auto least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(value_of(Integer(least)), mpz_class(static_cast<long>(least)));
  EXPECT_EQ(Integer(0).sign(), 0);
  EXPECT_EQ(value_of(Integer(-1)), -1);
  Integer n = 1;
  EXPECT_EQ(--n, Integer(0));
  EXPECT_EQ(--n, Integer(-1));
}

}  // namespace
}  // namespace rondel::test
