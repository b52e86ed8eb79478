// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integers of any size, as a sign and a magnitude in words of 64 bits. Products and quotients take
// the time of the product of both lengths: the numbers of an exact decision have some 200 words at
// most, below which nothing cleverer is faster.
#pragma once

#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

#include "exact/words.h"

namespace rondel::exact {

class Integer {
 public:
  Integer() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): formulas mix both, as they do with numbers
  Integer(std::int64_t value);

  [[nodiscard]] int sign() const { return words_.empty() ? 0 : (is_negative_ ? -1 : 1); }
  // The length of the magnitude in bits; 0 for zero.
  [[nodiscard]] unsigned num_bits() const;
  // How many of the lowest bits are zero. Precondition: the number is not zero.
  [[nodiscard]] unsigned trailing_zeros() const;
  // The magnitude modulo 2^64.
  [[nodiscard]] Word low_word() const { return words_.empty() ? 0 : words_.front(); }

  Integer operator-() const;
  Integer& operator+=(const Integer& b);
  Integer& operator-=(const Integer& b) { return *this += -b; }
  Integer& operator--() { return *this += Integer(-1); }

  friend Integer operator+(Integer a, const Integer& b) { return a += b; }
  friend Integer operator-(Integer a, const Integer& b) { return a -= b; }
  friend Integer operator*(const Integer& a, const Integer& b);
  // a 2^bits, and a / 2^bits rounded towards zero.
  friend Integer operator<<(const Integer& a, unsigned bits);
  friend Integer operator>>(const Integer& a, unsigned bits);
  // The magnitude modulo 2^bits.
  friend Integer low_bits(Integer a, unsigned bits);
  friend Integer abs(Integer a);

  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b);
  friend bool operator==(const Integer& a, const Integer& b) = default;

  // The quotient a / b, rounded towards zero, and the remainder, which has the sign of a.
  // Precondition: b is not zero.
  friend std::pair<Integer, Integer> divide(const Integer& a, const Integer& b);
  friend Integer operator/(const Integer& a, const Integer& b) { return divide(a, b).first; }

 private:
  // Restores the invariant: the last word is not zero, and zero is not negative.
  void trim();

  std::vector<Word> words_;  // of the magnitude, the lowest first
  bool is_negative_ = false;
};

}  // namespace rondel::exact
