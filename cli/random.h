// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Random numbers that are the same everywhere; the standard library's distributions are not.
#pragma once

#include <cmath>
#include <cstdint>

#include "rondel/types.h"

namespace rondel::cli {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): a counter and a mixing function.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e37'79b9'7f4a'7c15U);
    z = (z ^ (z >> 30)) * 0xbf58'476d'1ce4'e5b9U;
    z = (z ^ (z >> 27)) * 0x94d0'49bb'1331'11ebU;
    return z ^ (z >> 31);
  }

  /// A multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In [-1, 1).
  double symmetric() { return 2 * unit() - 1; }
  /// In [0, bound), for a bound far below 2^64.
  std::uint64_t below(std::uint64_t bound) { return bits() % bound; }

  /// Uniform on the sphere, by Marsaglia's method (1972), without a sine.
  Point direction() {
    for (;;) {
      const double u = symmetric();
      const double v = symmetric();
      const double s = u * u + v * v;
      if (s >= 1) continue;
      const double scale = 2 * std::sqrt(1 - s);
      return {u * scale, v * scale, 1 - 2 * s};
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace rondel::cli
