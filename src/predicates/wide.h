// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Doubles with exponents of their own, for vectors whose coordinates differ so much in magnitude that
// no power of two keeps all products among the doubles.
//
// A Wide knows the size of its value: what the same formula would give if all its terms were positive.
// As no operation loses more than u of the sizes it adds or multiplies, a value is off by at most
// k u size, where k counts the roundings that one product of the formula goes through (bounds.h).
// What has no difference in it is its size, and a Floating.
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

// value * 2^exponent. The value is 0, or at least 1/8 and below 2^6.
struct Floating {
  double value = 0;
  int exponent = -(1 << 20);  // below that of any product

  Floating(double v, int e) : value(v), exponent(e) {}
  // What overflowed is infinite, or no number: no sign is sure of it.
  explicit Floating(double v) {
    if (v == 0) return;
    exponent = exponent_of(v);
    if (exponent == 1024) {
      value = std::numeric_limits<double>::infinity();
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
  }

  [[nodiscard]] double size() const { return std::abs(value); }
  // In units of 2^unit. What is far below them is off by less than 2^-990.
  [[nodiscard]] double in(int unit) const {
    return value * power_of_two(std::max(exponent - unit, -max_exponent));
  }

  friend Floating operator*(const Floating& a, const Floating& b) {
    return {a.value * b.value, a.exponent + b.exponent};
  }
  friend Floating operator-(const Floating& a) { return {-a.value, a.exponent}; }
};

// The size is 0, or at least 1/8 and below 2^30 in formulas of degree 6.
struct Wide {
  double value;
  double of_terms;  // the size
  int exponent;

  [[nodiscard]] double size() const { return of_terms; }
  // Whether the sign of the value is that of the exact one.
  [[nodiscard]] Sign sign_if_beyond(double bound) const {
    return unless_unsure(value, std::abs(value) > bound * of_terms);
  }
  // A term far below the other one is off by less than 2^-990 of that.
  static Wide difference(const Floating& a, const Floating& b) {
    const int highest = std::max(a.exponent, b.exponent);
    const double of_a = a.in(highest);
    const double of_b = b.in(highest);
    return {of_a - of_b, std::abs(of_a) + std::abs(of_b), highest};
  }
};

// The determinant of three rows in units of its largest product: two roundings in each of the six,
// three in their sum. Products far below the largest one are off by less than 2^-960 of that.
template <class Number>
Wide det_of_rows(const exact::Vector3<Number>& a, const exact::Vector3<Number>& b,
                 const exact::Vector3<Number>& c) {
  const auto exponent = [](const Number& x, const Number& y, const Number& z) {
    return x.exponent + y.exponent + z.exponent;
  };
  const std::array<int, 6> exponents = {exponent(a.x, b.y, c.z), exponent(a.y, b.z, c.x),
                                        exponent(a.z, b.x, c.y), exponent(a.x, b.z, c.y),
                                        exponent(a.y, b.x, c.z), exponent(a.z, b.y, c.x)};
  const int highest = std::max(
      {exponents[0], exponents[1], exponents[2], exponents[3], exponents[4], exponents[5]});
  std::array<double, 6> values{};
  std::array<double, 6> sizes{};
  const auto multiply = [&](std::size_t i, const Number& x, const Number& y, const Number& z) {
    const double unit = power_of_two(std::max(exponents[i] - highest, -max_exponent));
    values[i] = unit * (x.value * y.value * z.value);
    sizes[i] = unit * (x.size() * y.size() * z.size());
  };
  multiply(0, a.x, b.y, c.z);
  multiply(1, a.y, b.z, c.x);
  multiply(2, a.z, b.x, c.y);
  multiply(3, a.x, b.z, c.y);
  multiply(4, a.y, b.x, c.z);
  multiply(5, a.z, b.y, c.x);
  const double value =
      ((values[0] - values[3]) + (values[1] - values[4])) + (values[2] - values[5]);
  const double size = ((sizes[0] + sizes[3]) + (sizes[1] + sizes[4])) + (sizes[2] + sizes[5]);
  return {value, size, highest};
}

using FloatingVector = exact::Vector3<Floating>;
using WideVector = exact::Vector3<Wide>;

inline FloatingVector to_floating(const Vector& v) {
  return {Floating(v.x), Floating(v.y), Floating(v.z)};
}

// A row of the determinant in side_of_circle_wide.cpp.
struct WideRow {
  Floating x;
  Floating y;
  Floating z;
  Floating h;
};

// A ray, and the axis that is its longest coordinate's.
struct WideRay {
  std::array<Floating, 3> along;
  std::size_t axis = 0;
  bool is_backward = false;  // on the axis
  int longest = 0;           // exponent of the coordinate on the axis
  int distance = 0;          // exponent of the longer one of the others, counted from that

  explicit WideRay(const Vector& v) : along{Floating(v.x), Floating(v.y), Floating(v.z)} {
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
    const Floating x = is_reflected ? -along[axis_of_x] : along[axis_of_x];
    const Floating& y = along[(axis_of_x + 1) % 3];
    const Floating& z = along[(axis_of_x + 2) % 3];
    const int longer = 2 * std::max(y.exponent, z.exponent);
    const Floating squared = {(y * y).in(longer) + (z * z).in(longer), longer};
    const double forward = x.in(longest);
    const double length = std::sqrt(forward * forward + squared.in(2 * longest));
    const double sum = length + std::abs(forward);
    if (forward <= 0) return {x, y, z, {sum, longest}};
    return {x, y, z, {squared.value / sum, longer - longest}};
  }
};

// The row of a ray less what makes its first entry 0, which is left out.
inline WideVector less_origin(const WideRow& q, const WideRow& o) {
  return {Wide::difference(o.x * q.y, q.x * o.y), Wide::difference(o.x * q.z, q.x * o.z),
          Wide::difference(o.x * q.h, q.x * o.h)};
}

}  // namespace rondel::predicates
