// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact signs of formulas over the coordinates of points, by balls of more and more words.
#pragma once

#include <cassert>
#include <cstddef>
#include <optional>

#include "exact/ball.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::exact {

template <std::size_t N>
using BallVector = Vector3<Ball<N>>;

// The step from one point to another: exact while it fits into N words.
template <std::size_t N>
struct BallStep {
  BallVector<N> operator()(const Point& from, const Point& to) const {
    const auto difference = [](double a, double b) {
      return b == 0 ? Ball<N>(a) : Ball<N>(a) - Ball<N>(b);
    };
    return {difference(to.x, from.x), difference(to.y, from.y), difference(to.z, from.z)};
  }
};

// What formula(BallStep<N>()), an optional Sign, says for the first N of the list that knows.
template <std::size_t N, std::size_t... more, class Formula>
std::optional<Sign> first_known_sign(const Formula& formula) {
  const std::optional<Sign> sign = formula(BallStep<N>());
  if constexpr (sizeof...(more) == 0) {
    return sign;
  } else {
    return sign ? sign : first_known_sign<more...>(formula);
  }
}

// The sign of a polynomial of degree 3 or less in steps, a sum of at most 64 products:
// formula(step) is a Ball. A step is a multiple of 2^-1074 below 2^1025, so a product of three is
// one of 2^-3222, a sum of 64 below 2^3081, and 6303 bits are less than 104 words: the last try is
// exact.
template <class Formula>
Sign sign_of_cubic(const Formula& formula) {
  const std::optional<Sign> sign =
      first_known_sign<4, 16, 104>([&](const auto& step) { return formula(step).sign(); });
  assert(sign);
  return *sign;
}

// The sign of a formula of degree 6 in steps and other doubles and 2 - t for doubles t in [0, 2],
// which is an optional Sign: its value has at most 6 * 2101 + 64 bits.
template <class Formula>
Sign sign_of_sextic(const Formula& formula) {
  const std::optional<Sign> sign = first_known_sign<6, 16, 208>(formula);
  assert(sign);
  return *sign;
}

}  // namespace rondel::exact
