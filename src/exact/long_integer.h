// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integers of 128 bits, where the compiler need not have any.
#pragma once

#include <compare>
#include <cstdint>

#include "exact/words.h"

namespace rondel::exact {

// Two's complement. Sums and differences wrap around.
class LongInteger {
 public:
  LongInteger() = default;

  static LongInteger product(std::int64_t a, std::int64_t b) {
    const TwoWords words = multiply_and_add(magnitude(a), magnitude(b), 0, 0);
    const LongInteger result(words.low, words.high);
    return (a < 0) == (b < 0) ? result : -result;
  }

  [[nodiscard]] int sign() const {
    if ((high_ >> 63U) != 0) return -1;
    return (low_ | high_) == 0 ? 0 : 1;
  }

  LongInteger operator-() const { return LongInteger() - *this; }

  friend LongInteger operator+(const LongInteger& a, const LongInteger& b) {
    const Word low = a.low_ + b.low_;
    return {low, a.high_ + b.high_ + (low < a.low_ ? 1U : 0U)};
  }
  friend LongInteger operator-(const LongInteger& a, const LongInteger& b) {
    return {a.low_ - b.low_, a.high_ - b.high_ - (a.low_ < b.low_ ? 1U : 0U)};
  }
  friend bool operator==(const LongInteger& a, const LongInteger& b) = default;
  friend std::strong_ordering operator<=>(const LongInteger& a, const LongInteger& b) {
    const auto by_high = static_cast<std::int64_t>(a.high_) <=> static_cast<std::int64_t>(b.high_);
    return by_high != 0 ? by_high : a.low_ <=> b.low_;
  }

 private:
  LongInteger(Word low, Word high) : low_(low), high_(high) {}

  static Word magnitude(std::int64_t a) {
    return a < 0 ? Word{0} - static_cast<Word>(a) : static_cast<Word>(a);
  }

  Word low_ = 0;
  Word high_ = 0;
};

}  // namespace rondel::exact
