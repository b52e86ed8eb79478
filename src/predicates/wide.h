// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Doubles with exponents of their own, for vectors whose coordinates differ so much in magnitude that
// no power of two keeps all products among the doubles.
//
// A Wide knows the size of its value: what the same formula would give if all its terms were positive.
// As no operation loses more than u of the sizes it adds or multiplies, a value is off by at most
// k u size, where k counts the roundings that one product of the formula goes through (bounds.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "predicates/scale.h"

namespace rondel::predicates {

// value * 2^exponent. The size is 0, or at least 1/8 and below 2^30 in formulas of degree 6.
struct Wide {
  double value = 0;
  double size = 0;
  int exponent = -(1 << 20);  // below that of any product

  Wide() = default;
  Wide(double v, double s, int e) : value(v), size(s), exponent(e) {}
  // What overflowed is infinite, or no number, with an infinite size: no sign is sure of it.
  explicit Wide(double v) {
    if (v == 0) return;
    exponent = exponent_of(v);
    if (exponent == 1024) {
      value = size = std::numeric_limits<double>::infinity();
      return;
    }
    if (exponent == -1023) {
      constexpr int shift = 64;
      v *= power_of_two(shift);
      exponent = exponent_of(v) - shift;
    }
    constexpr std::uint64_t exponent_bits = std::uint64_t{0x7ff} << 52U;
    constexpr auto one = std::bit_cast<std::uint64_t>(1.0);
    value = std::bit_cast<double>((std::bit_cast<std::uint64_t>(v) & ~exponent_bits) | one);
    size = std::abs(value);
  }

  // In units of 2^unit. What is far below them is off by less than 2^-990.
  [[nodiscard]] double in(int unit) const {
    return value * power_of_two(std::max(exponent - unit, -most_exponent));
  }
  // Whether the sign of the value is that of the exact one.
  [[nodiscard]] Sign sign_if_beyond(double bound) const {
    return unless_unsure(value, std::abs(value) > bound * size);
  }

  friend Wide operator*(const Wide& a, const Wide& b) {
    return {a.value * b.value, a.size * b.size, a.exponent + b.exponent};
  }
  friend Wide operator-(const Wide& a) { return {-a.value, a.size, a.exponent}; }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  // A term far below the other one is off by less than 2^-960 of that.
  friend Wide operator+(const Wide& a, const Wide& b) {
    const int highest = std::max(a.exponent, b.exponent);
    const double of_a = power_of_two(std::max(a.exponent - highest, -most_exponent));
    const double of_b = power_of_two(std::max(b.exponent - highest, -most_exponent));
    return {of_a * a.value + of_b * b.value, of_a * a.size + of_b * b.size, highest};
  }
};

using WideVector = exact::Vector3<Wide>;

inline WideVector to_wide(const Vector& v) { return {Wide(v.x), Wide(v.y), Wide(v.z)}; }

// A row of the determinant in side_of_circle_wide.cpp.
struct WideRow {
  Wide x;
  Wide y;
  Wide z;
  Wide h;
};

// A ray, and the axis that is its longest coordinate's.
struct WideRay {
  std::array<Wide, 3> along;
  std::size_t axis = 0;
  bool is_backward = false;  // on the axis
  int longest = 0;           // exponent of the coordinate on the axis
  int distance = 0;          // exponent of the longer one of the others, counted from that

  explicit WideRay(const Vector& v) : along{Wide(v.x), Wide(v.y), Wide(v.z)} {
    const auto longer = [&v](std::size_t i, std::size_t j) {
      const std::array<double, 3> size = {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
      return size[i] < size[j] ? j : i;
    };
    axis = longer(longer(0, 1), 2);
    is_backward = along[axis].value < 0;
    longest = along[axis].exponent;
    distance = std::max(along[(axis + 1) % 3].exponent, along[(axis + 2) % 3].exponent) - longest;
  }

  [[nodiscard]] WideRow row(std::size_t axis_of_x, bool is_reflected) const {
    const Wide x = is_reflected ? -along[axis_of_x] : along[axis_of_x];
    const Wide& y = along[(axis_of_x + 1) % 3];
    const Wide& z = along[(axis_of_x + 2) % 3];
    const Wide squared = y * y + z * z;
    const double forward = x.in(longest);
    const double length = std::sqrt(forward * forward + squared.in(2 * longest));
    const double sum = length + std::abs(forward);
    if (forward <= 0) return {x, y, z, {sum, sum, longest}};
    return {x, y, z, {squared.value / sum, squared.size / sum, squared.exponent - longest}};
  }
};

// The row of a ray less what makes its first entry 0, which is left out.
inline WideVector less_origin(const WideRow& q, const WideRow& o) {
  return {o.x * q.y - q.x * o.y, o.x * q.z - q.x * o.z, o.x * q.h - q.x * o.h};
}

}  // namespace rondel::predicates
