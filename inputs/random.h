// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Random numbers that are the same everywhere, unlike the standard library's distributions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "rondel/types.h"

namespace rondel::inputs {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): a counter and a mixing function.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e37'79b9'7f4a'7c15U);
    z = (z ^ (z >> 30)) * 0xbf58'476d'1ce4'e5b9U;
    z = (z ^ (z >> 27)) * 0x94d0'49bb'1331'11ebU;
    return z ^ (z >> 31);
  }

  /// Returns a number below `bound`; the bias of the remainder does not matter if the bound is far
  /// below 2^64.
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }
  /// Returns a number in [low, high].
  int between(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1)));
  }
  /// Returns a multiple of 2^-53 in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// Returns a number in [-1, 1).
  double signed_unit() { return 2 * unit() - 1; }
  bool coin() { return (next() >> 63) != 0; }

  Point in_cube() {
    const double x = signed_unit();
    const double y = signed_unit();
    return {x, y, signed_unit()};
  }
  Point in_ball() {
    for (;;) {
      const Point p = in_cube();
      if (p.x * p.x + p.y * p.y + p.z * p.z <= 1) return p;
    }
  }
  /// Returns a uniform direction without a sine: a point of the ball that is not too near to its
  /// center, normalized.
  Point direction() {
    for (;;) {
      const Point p = in_ball();
      const double squared = p.x * p.x + p.y * p.y + p.z * p.z;
      if (squared <= 0.01) continue;
      const double length = std::sqrt(squared);
      return {p.x / length, p.y / length, p.z / length};
    }
  }

  template <typename T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace rondel::inputs
