// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/integer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rondel::exact {
namespace {

// value = mantissa * 2^exponent with an odd mantissa; 0 has exponent `no_exponent`.
struct Scaled {
  std::int64_t mantissa;
  int exponent;
};
constexpr int no_exponent = 1 << 20;

Scaled decompose(double value) {
  if (value == 0) return {0, no_exponent};
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  return {mantissa >> zeros, exponent - 53 + zeros};
}

// value * 2^-lowest, where lowest <= the exponent of value.
Integer to_integer(const Scaled& value, int lowest) {
  if (value.mantissa == 0) return 0;
  return Integer(value.mantissa) << static_cast<unsigned>(value.exponent - lowest);
}

int lowest_exponent(const Point& p) {
  return std::min({decompose(p.x).exponent, decompose(p.y).exponent, decompose(p.z).exponent});
}

IntegerVector to_integers(const Point& p, int lowest) {
  return {to_integer(decompose(p.x), lowest), to_integer(decompose(p.y), lowest),
          to_integer(decompose(p.z), lowest)};
}

struct Root {
  Integer floor;
  Integer remainder;  // of the number, less the square of the floor
};

// \pre n < 2^62.
Root small_root(const Integer& n) {
  const auto value = static_cast<std::int64_t>(n.low_word());
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(value)));
  while (root * root > value) --root;
  while ((root + 1) * (root + 1) <= value) ++root;
  return {root, value - root * root};
}

// Zimmermann, Karatsuba Square Root, INRIA RR-3805, 1999: n = high b^2 + middle b + low, b = 2^k,
// and the root of `high` is s with the remainder r. For the quotient q and the remainder u of r b +
// middle by 2 s,
//
//     n = (s b + q)^2 + u b + low - q^2.
//
// high >= b^2, hence s >= b and q <= b: the remainder is at most 2 s b, and if it is negative, the
// root less 1 has one that is not. One division of half the length at each level.
Root root_of(const Integer& n) {
  if (n.num_bits() <= 62) return small_root(n);
  const unsigned k = (n.num_bits() - 1) / 4;
  const auto [s, r] = root_of(n >> (2 * k));
  const auto [q, u] = divide((r << k) + low_bits(n >> k, k), s << 1);
  Root root = {(s << k) + q, (u << k) + low_bits(n, k) - q * q};
  if (root.remainder < 0) {
    root.remainder += 2 * root.floor - 1;
    --root.floor;
  }
  return root;
}

// The low bits of a square are those of 0, 1, 4, 9, 16, 17, 25, 33, 36, 41, 49 or 57 modulo 64.
bool is_square(const Integer& n, Integer& root) {
  constexpr std::uint64_t squares_modulo_64 = 0x0202021202030213U;
  if ((squares_modulo_64 >> (n.low_word() % 64) & 1U) == 0) return false;
  auto [floor, remainder] = root_of(n);
  root = std::move(floor);
  return remainder == 0;
}

// Sets `sign` and returns true when 2^bits times the sum lies outside of the error bound: each
// root is rounded down, so a term is wrong by less than |coefficient|.
bool sign_at_precision(std::span<const Integer> coefficients, std::span<const Integer> radicands,
                       unsigned bits, Sign& sign) {
  Integer sum = 0;
  Integer error = 0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const Integer root = floor_sqrt(radicands[i] << (2 * bits));
    sum += coefficients[i] * root;
    error += abs(coefficients[i]);
  }
  sign = sign_of(sum);
  return abs(sum) > error;
}

// Whether the sum over each class of roots is zero.
bool is_zero_by_classes(std::span<const Integer> coefficients, std::span<const Integer> radicands) {
  std::vector<bool> done(coefficients.size(), false);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (done[i]) continue;
    // The class sum divided by sqrt(r_i), times r_i: sqrt(r_j) = sqrt(r_i r_j) / r_i * sqrt(r_i).
    Integer sum = coefficients[i] * radicands[i];
    for (std::size_t j = i + 1; j < coefficients.size(); ++j) {
      Integer root;
      if (!is_square(radicands[i] * radicands[j], root)) continue;
      done[j] = true;
      sum += coefficients[j] * root;
    }
    if (sum != 0) return false;
  }
  return true;
}

}  // namespace

Integer floor_sqrt(const Integer& n) { return root_of(n).floor; }

std::vector<IntegerVector> scaled_differences(std::initializer_list<Point> points,
                                              const Point& center) {
  int lowest = lowest_exponent(center);
  for (const Point& p : points) lowest = std::min(lowest, lowest_exponent(p));
  const IntegerVector origin = to_integers(center, lowest);
  std::vector<IntegerVector> result;
  result.reserve(points.size());
  for (const Point& p : points) result.push_back(to_integers(p, lowest) - origin);
  return result;
}

std::vector<IntegerVector> scaled_rays(std::initializer_list<Point> points, const Point& center) {
  std::vector<IntegerVector> result;
  result.reserve(points.size());
  for (const Point& p : points) {
    const int lowest = std::min(lowest_exponent(center), lowest_exponent(p));
    result.push_back(to_integers(p, lowest) - to_integers(center, lowest));
  }
  return result;
}

Sign sign_of_root_sum(std::span<const Integer> coefficients, std::span<const Integer> radicands) {
  Sign sign = Sign::zero;
  constexpr unsigned first_precision = 192;
  if (sign_at_precision(coefficients, radicands, first_precision, sign)) return sign;
  if (is_zero_by_classes(coefficients, radicands)) return Sign::zero;
  for (unsigned bits = 2 * first_precision;; bits *= 2) {
    if (sign_at_precision(coefficients, radicands, bits, sign)) return sign;
  }
}

}  // namespace rondel::exact
