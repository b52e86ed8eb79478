// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact/integer_signs.h"

namespace rondel::exact {

#ifdef __SIZEOF_INT128__

namespace {

__extension__ using Long = __int128;

// One coordinate of three steps, times a power of two. Smaller than 2^61.
using Column = std::array<std::int64_t, 3>;

double power_of_two(std::uint64_t biased_exponent) {
  return std::bit_cast<double>(biased_exponent << 52U);
}

// The coordinate of the steps from o to the others, in a unit of which the longest coordinate has
// between 2^59 and 2^60; whether all are multiples of the unit, which is no subnormal number.
bool steps_along_axis(double o, double a, double b, double c, Column& steps) {
  constexpr std::uint64_t max_bits = 59;
  constexpr std::uint64_t bias = 1023;
  const std::array<double, 4> given = {o, a, b, c};
  double longest = 0;
  for (const double x : given) longest = std::max(longest, std::abs(x));
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(longest) >> 52U;
  if (exponent <= max_bits) {
    steps = {};
    return longest == 0;
  }
  const double unit = power_of_two(exponent - max_bits);
  const double per_unit = power_of_two(2 * bias + max_bits - exponent);
  std::array<std::int64_t, 4> integers{};
  bool are_exact = true;
  for (std::size_t i = 0; i < 4; ++i) {
    integers[i] = static_cast<std::int64_t>(per_unit * given[i]);
    are_exact &= static_cast<double>(integers[i]) * unit == given[i];
  }
  for (std::size_t i = 0; i < 3; ++i) steps[i] = integers[i + 1] - integers[0];
  return are_exact;
}

// x . (y x z). Each coordinate of y x z is smaller than 2^123. It is split into high 2^64 + low,
// with 0 <= low < 2^64 and |high| < 2^59: so three products with either are smaller than 2^127.
Sign sign_of_determinant(const Column& x, const Column& y, const Column& z) {
  Long high = 0;
  Long low = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Long minor = Long{y[j]} * z[k] - Long{y[k]} * z[j];
    high += (minor >> 64U) * x[i];
    low += static_cast<Long>(static_cast<std::uint64_t>(minor)) * x[i];
  }
  high += low >> 64U;
  if (high != 0) return high < 0 ? Sign::negative : Sign::positive;
  return static_cast<std::uint64_t>(low) == 0 ? Sign::zero : Sign::positive;
}

}  // namespace

std::optional<Sign> sign_of_volume_in_integers(const Point& o, const Point& a, const Point& b,
                                               const Point& c) {
  Column x;
  Column y;
  Column z;
  if (!steps_along_axis(o.x, a.x, b.x, c.x, x) || !steps_along_axis(o.y, a.y, b.y, c.y, y) ||
      !steps_along_axis(o.z, a.z, b.z, c.z, z)) {
    return std::nullopt;
  }
  return sign_of_determinant(x, y, z);
}

#else

std::optional<Sign> sign_of_volume_in_integers(const Point& /*o*/, const Point& /*a*/,
                                               const Point& /*b*/, const Point& /*c*/) {
  return std::nullopt;
}

#endif

}  // namespace rondel::exact
