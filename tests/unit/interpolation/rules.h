// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts that tests of the rules of all methods share.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "unit/interpolation/support.h"

namespace rondel::test {

inline constexpr std::array methods = {Method::nearest, Method::linear,  Method::laplace,
                                       Method::sibson,  Method::hermite, Method::cubic};

inline std::vector<double> some_field(std::size_t n) {
  Random random(11);
  std::vector<double> field(n);
  for (double& value : field) value = random.signed_unit();
  return field;
}

// Equal bit by bit, every NaN being like every other.
inline bool are_same(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return (std::isnan(x) && std::isnan(y)) ||
           std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

// Of a field of values up to 1: to rounding of the sums of rows.
inline bool are_close(std::span<const double> a, std::span<const double> b,
                      const Weights& weights) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    double scale = 0;
    for (const double w : row_of(weights, i % weights.num_rows()).values) scale += std::abs(w);
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::abs(a[i] - b[i]) > 1e-13 * scale) return false;
  }
  return true;
}

inline bool has_slopes(Method method) {
  return method == Method::hermite || method == Method::cubic;
}

// Sites 0, 2 and 5 share a place.
inline const std::vector<Point> shared = {{1, 0, 0}, {0, 1, 0},    {2, 0, 0},
                                          {0, 0, 1}, {-1, -1, -1}, {3, 0, 0}};

template <class Work>
void expect_refused(std::size_t index, const std::string& message, const Work& work) {
  try {
    work();
    ADD_FAILURE() << "not refused: " << message;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index) << error.what();
    EXPECT_EQ(std::string(error.what()), message);
  }
}

}  // namespace rondel::test
