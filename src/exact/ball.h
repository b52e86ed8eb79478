// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Balls: numbers of N words with a proven bound of their error, on the stack.
//
//     the exact value lies within 2^radius of the midpoint  +- digits * 2^exponent,
//
// or is the midpoint, as long as nothing was rounded. Exponents are ints, so no product of doubles
// over- or underflows. Each operation adds to the radius what it drops, so a formula needs no
// analysis of its own: its sign is known, or it is known to be unknown, and more words are tried.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "exact/words.h"
#include "rondel/types.h"

namespace rondel::exact {

// A power of two 2^e as a bound of a size or an error, by its exponent. No bound, of the size of
// zero or the error of an exact number, is `nothing`.
using Magnitude = int;
inline constexpr Magnitude nothing = std::numeric_limits<int>::min() / 4;

// At least the sum of the two.
inline Magnitude sum_of(Magnitude a, Magnitude b) {
  if (a == nothing || b == nothing) return std::max(a, b);
  return std::max(a, b) + 1;
}

inline Magnitude product_of(Magnitude a, Magnitude b) {
  return a == nothing || b == nothing ? nothing : a + b;
}

template <std::size_t N>
class Ball {
 public:
  Ball() = default;  // 0
  // Precondition: finite.
  explicit Ball(double value) {
    constexpr int mantissa_bits = 52;
    constexpr int min_exponent = -1074;
    const auto bits = std::bit_cast<Word>(value);
    const Word fraction = bits & ((Word{1} << mantissa_bits) - 1);
    const auto biased = static_cast<int>(bits >> mantissa_bits & 0x7ffU);
    const Word mantissa = biased == 0 ? fraction : fraction | Word{1} << mantissa_bits;
    if (mantissa == 0) return;
    const int zeros = std::countl_zero(mantissa);
    digits_[N - 1] = mantissa << zeros;
    exponent_ = min_exponent + std::max(biased - 1, 0) - zeros - last_word;
    is_negative_ = value < 0;
  }

  // The sign of the exact value, if it is known.
  [[nodiscard]] std::optional<Sign> sign() const {
    if (is_zero_midpoint()) return is_exact() ? std::optional(Sign::zero) : std::nullopt;
    if (!is_exact() && radius_ >= size_of_midpoint() - 1) return std::nullopt;
    return is_negative_ ? Sign::negative : Sign::positive;
  }
  [[nodiscard]] bool is_exact() const { return radius_ == nothing; }
  [[nodiscard]] Magnitude radius() const { return radius_; }
  // The value is smaller than 2^size().
  [[nodiscard]] Magnitude size() const { return sum_of(size_of_midpoint(), radius_); }
  // The midpoint, taken as the value.
  [[nodiscard]] Ball midpoint() const {
    Ball r = *this;
    r.radius_ = nothing;
    return r;
  }
  // The midpoint's first 64 bits, where it is not 0: leading() * 2^(size_of_midpoint() - 64).
  [[nodiscard]] Word leading() const { return digits_[N - 1]; }
  [[nodiscard]] Magnitude size_of_midpoint() const {
    return is_zero_midpoint() ? nothing : exponent_ + num_bits;
  }
  [[nodiscard]] Ball times_power_of_two(int power) const {
    Ball r = *this;
    r.exponent_ += power;
    r.radius_ = product_of(radius_, power);
    return r;
  }
  // The ball with this midpoint whose radius is larger by 2^error or more.
  [[nodiscard]] Ball wider_by(Magnitude error) const {
    Ball r = *this;
    r.radius_ = sum_of(radius_, error);
    return r;
  }

  friend Ball operator-(const Ball& a) {
    Ball r = a;
    r.is_negative_ = !a.is_negative_;
    return r;
  }
  friend Ball operator+(const Ball& a, const Ball& b) { return a.plus(b, b.is_negative_); }
  friend Ball operator-(const Ball& a, const Ball& b) { return a.plus(b, !b.is_negative_); }

  friend Ball operator*(const Ball& a, const Ball& b) {
    Ball r;
    if (a.radius_ != nothing || b.radius_ != nothing) r.radius_ = radius_of_product(a, b);
    if (a.is_zero_midpoint() || b.is_zero_midpoint()) return r;
    r.is_negative_ = a.is_negative_ != b.is_negative_;
    r.exponent_ = a.exponent_ + b.exponent_ + num_bits;
    Words<2 * N> product{};
    multiply(a.digits_, b.digits_, product);
    const unsigned zeros = product[2 * N - 1] >> (word_bits - 1) == 0 ? 1 : 0;
    const bool is_cut = take_highest_words(product, zeros, r.digits_);
    r.exponent_ -= static_cast<int>(zeros);
    if (is_cut) r.radius_ = sum_of(r.radius_, r.exponent_);
    return r;
  }

 private:
  static constexpr int word_bits = 64;
  static constexpr int num_bits = static_cast<int>(N) * word_bits;
  static constexpr int last_word = num_bits - word_bits;

  [[nodiscard]] bool is_zero_midpoint() const { return digits_[N - 1] == 0; }

  // |x y - x' y'| <= |x| r_y + |y| r_x + r_x r_y for midpoints x', y' and radii r.
  static Magnitude radius_of_product(const Ball& a, const Ball& b) {
    const Magnitude size_a = a.size_of_midpoint();
    const Magnitude size_b = b.size_of_midpoint();
    return sum_of(sum_of(product_of(size_a, b.radius_), product_of(size_b, a.radius_)),
                  product_of(a.radius_, b.radius_));
  }

  // The midpoint becomes words * 2^exponent, cut to N words.
  void round(const Words<N + 1>& words, int exponent) {
    exponent_ = exponent;
    if (words[N] == 0 && words[N - 1] >> (word_bits - 1) != 0) {
      std::copy_n(words.begin(), N, digits_.begin());
      return;
    }
    std::size_t length = N + 1;
    while (length > 0 && words[length - 1] == 0) --length;
    if (length == 0) {
      digits_ = {};
      return;
    }
    const auto zeros = static_cast<unsigned>(std::countl_zero(words[length - 1]));
    const bool is_cut = shift_left_to_end(words, length, zeros, digits_);
    exponent_ +=
        (static_cast<int>(length) - static_cast<int>(N)) * word_bits - static_cast<int>(zeros);
    if (is_cut) radius_ = sum_of(radius_, exponent_);
  }

  // The sum with b, which counts as negative or not as told.
  [[nodiscard]] Ball plus(const Ball& b, bool is_b_negative) const {
    const bool is_b_longer =
        is_zero_midpoint() || (!b.is_zero_midpoint() && b.exponent_ > exponent_);
    const Ball& longer = is_b_longer ? b : *this;
    const Ball& shorter = is_b_longer ? *this : b;
    Ball r;
    r.radius_ = sum_of(radius_, b.radius_);
    r.is_negative_ = is_b_longer ? is_b_negative : is_negative_;
    if (shorter.is_zero_midpoint()) {
      r.digits_ = longer.digits_;
      r.exponent_ = longer.exponent_;
      return r;
    }
    Words<N> moved;
    const auto distance = static_cast<unsigned>(longer.exponent_ - shorter.exponent_);
    if (shift_right(shorter.digits_, distance, moved)) {
      r.radius_ = sum_of(r.radius_, longer.exponent_);
    }
    Words<N + 1> sum;
    if (is_negative_ == is_b_negative) {
      add(longer.digits_, moved, sum);
    } else if (subtract(longer.digits_, moved, sum)) {
      r.is_negative_ = !r.is_negative_;
    }
    r.round(sum, longer.exponent_);
    return r;
  }

  // The highest bit of the last word is set, or all are 0.
  Words<N> digits_{};
  int exponent_ = 0;
  Magnitude radius_ = nothing;
  bool is_negative_ = false;
};

// The double made of the first 64 bits of the midpoint: nearest to it but for one case in 2^11.
template <std::size_t N>
double leading_double(const Ball<N>& ball) {
  const Magnitude size = ball.size_of_midpoint();
  if (size == nothing) return 0;
  const double value = std::ldexp(static_cast<double>(ball.leading()), size - 64);
  return ball.midpoint().sign() == Sign::negative ? -value : value;
}

// 1 / sqrt(a); empty if a may be 0 or negative, or is known too badly.
//
// For any y and e = 1 - a y^2 it is y / sqrt(1 - e) = y (1 + e/2 + 3/8 e^2) + d, where |e| <= 1/2
// makes |d| <= |y| |e|^3. So the last step is proven whatever came before, and a step makes three
// times as many bits right: the first y has 50.
template <std::size_t N>
std::optional<Ball<N>> inverse_square_root(const Ball<N>& a) {
  if (a.sign() != Sign::positive) return std::nullopt;
  Ball<N> y = Ball<N>(first_inverse_root(a.leading(), a.size_of_midpoint() % 2 != 0))
                  .times_power_of_two(-floor_half(a.size_of_midpoint()));
  const Ball<N> one(1.0);
  for (std::size_t right_bits = 50;; right_bits *= 3) {
    const Ball<N> e = one - a * (y * y);
    if (e.size() > -8) return std::nullopt;
    const Magnitude squared = product_of(e.size(), e.size());
    const Ball<N> half = e.times_power_of_two(-1);
    const Ball<N> next = y + y * (half + Ball<N>(0.375) * (e * e));
    if (3 * right_bits >= 64 * N || squared == nothing) {
      return next.wider_by(product_of(y.size(), product_of(squared, e.size())));
    }
    y = next.midpoint();
  }
}

}  // namespace rondel::exact
