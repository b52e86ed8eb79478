// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integers of 128 bits beside GMP's.
#include "exact/long_integer.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/random.h"

namespace rondel::test {
namespace {

using exact::LongInteger;

// Numbers at the ends of their range and at powers of two, and random ones of every length.
std::vector<std::int64_t> numbers() {
  std::vector<std::int64_t> found = {0, std::numeric_limits<std::int64_t>::min(),
                                     std::numeric_limits<std::int64_t>::max()};
  Random random(7);
  for (unsigned shift = 1; shift < 64; shift += 3) {
    for (const std::uint64_t x : {std::uint64_t{1} << (63U - shift), random.next() >> shift}) {
      found.push_back(static_cast<std::int64_t>(x));
      found.push_back(-static_cast<std::int64_t>(x));
    }
  }
  return found;
}

mpz_class number(std::int64_t x) { return mpz_class(static_cast<long>(x)); }

TEST(long_integer, is_as_gmp_says) {
  const std::vector<std::int64_t> all = numbers();
  Random random(8);
  for (const std::int64_t a : all) {
    for (const std::int64_t b : all) {
      // Halves, so that sums of two products fit.
      const std::int64_t c = all[random.below(all.size())] / 2;
      const std::int64_t d = all[random.below(all.size())] / 2;
      const LongInteger first = LongInteger::product(a, b);
      const LongInteger second = LongInteger::product(c, d);
      const mpz_class x = number(a) * number(b);
      const mpz_class y = number(c) * number(d);
      ASSERT_EQ(first.sign(), sgn(x)) << a << " " << b;
      ASSERT_EQ((-second).sign(), -sgn(y)) << c << " " << d;
      ASSERT_EQ(first == second, x == y);
      ASSERT_EQ(first < second, x < y) << a << " " << b << " " << c << " " << d;
      ASSERT_EQ((first + second).sign(), sgn(mpz_class(x + y)));
      ASSERT_EQ((first - second).sign(), sgn(mpz_class(x - y)));
      ASSERT_EQ(first + second - first, second);
    }
  }
}

}  // namespace
}  // namespace rondel::test
