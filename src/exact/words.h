// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Natural numbers of a fixed number of 64-bit words, the lowest first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rondel::exact {

using Word = std::uint64_t;

template <std::size_t N>
using Words = std::array<Word, N>;

struct TwoWords {
  Word low;
  Word high;
};

// a b + c + d, which two words always hold, by products of half words.
inline TwoWords multiply_and_add_halves(Word a, Word b, Word c, Word d) {
  constexpr Word half = 0xffffffffU;
  const Word first = (a & half) * (b & half) + (c & half) + (d & half);
  const Word second = (a >> 32U) * (b & half) + (c >> 32U) + (first >> 32U);
  const Word third = (a & half) * (b >> 32U) + (d >> 32U) + (second & half);
  return {third << 32U | (first & half),
          (a >> 32U) * (b >> 32U) + (second >> 32U) + (third >> 32U)};
}

inline TwoWords multiply_and_add(Word a, Word b, Word c, Word d) {
#ifdef __SIZEOF_INT128__
  __extension__ using Long = unsigned __int128;
  const Long r = static_cast<Long>(a) * b + c + d;
  return {static_cast<Word>(r), static_cast<Word>(r >> 64U)};
#else
  return multiply_and_add_halves(a, b, c, d);
#endif
}

// Words of 0 cost next to nothing: numbers made of doubles have many.
template <std::size_t N>
void multiply(const Words<N>& a, const Words<N>& b, Words<2 * N>& product) {
  std::size_t first = 0;
  while (first < N && b[first] == 0) ++first;
  for (std::size_t i = 0; i < N; ++i) {
    if (a[i] == 0) continue;
    Word carry = 0;
    for (std::size_t j = first; j < N; ++j) {
      const TwoWords t = multiply_and_add(a[i], b[j], product[i + j], carry);
      product[i + j] = t.low;
      carry = t.high;
    }
    product[i + N] = carry;
  }
}

template <std::size_t N>
void add(const Words<N>& a, const Words<N>& b, Words<N + 1>& sum) {
  Word carry = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Word s = a[i] + b[i];
    sum[i] = s + carry;
    carry = static_cast<Word>(s < a[i]) + static_cast<Word>(sum[i] < s);
  }
  sum[N] = carry;
}

// |a - b|; whether a < b.
template <std::size_t N>
bool subtract(const Words<N>& a, const Words<N>& b, Words<N + 1>& difference) {
  Word borrow = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Word d = a[i] - b[i];
    difference[i] = d - borrow;
    borrow = static_cast<Word>(a[i] < b[i]) + static_cast<Word>(d < borrow);
  }
  difference[N] = 0;
  if (borrow == 0) return false;
  Word carry = 1;
  for (std::size_t i = 0; i < N; ++i) {
    difference[i] = ~difference[i] + carry;
    carry = static_cast<Word>(carry != 0 && difference[i] == 0);
  }
  return true;
}

// `result` is the first half of a after a shift by 0 or 1; whether something is left of a.
template <std::size_t N>
bool take_highest_words(const Words<2 * N>& a, unsigned shift, Words<N>& result) {
  Word rest = a[N - 1] << shift;
  for (std::size_t i = 0; i + 1 < N; ++i) rest |= a[i];
  for (std::size_t i = 0; i < N; ++i) {
    result[i] = a[N + i] << shift | (a[N + i - 1] >> 63U & shift);
  }
  return rest != 0;
}

// `result` is a / 2^distance, rounded down; whether that is not exact.
template <std::size_t N>
bool shift_right(const Words<N>& a, unsigned distance, Words<N>& result) {
  const std::size_t whole = std::min<std::size_t>(distance / 64, N);
  const unsigned part = distance % 64;
  const unsigned left = 63 - part;
  Word dropped = 0;
  for (std::size_t i = 0; i < whole; ++i) dropped |= a[i];
  if (whole < N) dropped |= a[whole] << 1U << left;
  for (std::size_t i = 0; i + whole + 1 < N; ++i) {
    result[i] = a[i + whole] >> part | a[i + whole + 1] << 1U << left;
  }
  if (whole < N) result[N - 1 - whole] = a[N - 1] >> part;
  for (std::size_t i = N - whole; i < N; ++i) result[i] = 0;
  return dropped != 0;
}

// `result` is the first N words of a, which has `length`, after a shift by less than a word;
// whether something is left of a.
template <std::size_t M, std::size_t N>
bool shift_left_to_end(const Words<M>& a, std::size_t length, unsigned distance, Words<N>& result) {
  const auto word = [&](std::size_t places_from_end) {
    return places_from_end <= length ? a[length - places_from_end] : 0;
  };
  Word next = word(1);
  for (std::size_t i = 1; i <= N; ++i) {
    const Word here = next;
    next = word(i + 1);
    result[N - i] = distance == 0 ? here : here << distance | next >> (64 - distance);
  }
  Word rest = next << distance;
  for (std::size_t i = N + 2; i <= length; ++i) rest |= word(i);
  return rest != 0;
}

// About 1 / sqrt(x) to 50 bits, for x = leading 2^-64, or twice that.
inline double first_inverse_root(Word leading, bool twice) {
  const double x = static_cast<double>(leading) * (twice ? 0x1p-63 : 0x1p-64);
  return 1 / std::sqrt(x);
}

// Rounded towards minus infinity.
inline int floor_half(int n) { return (n - (n < 0 && n % 2 != 0 ? 1 : 0)) / 2; }

}  // namespace rondel::exact
