// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pairs of doubles whose sums and products are remembered as one operation each, in place of those of
// src/exact/eft.h: the theorems start from what one such operation is off by. Everything else is that
// header's.
//
// A pair that is put together from two numbers is given, and so is the difference of two that are given:
// the theorems have premises on them.
#pragma once

#define DoubleDouble TwoDoubles
#include_next "exact/eft.h"
#undef DoubleDouble

namespace rondel::exact {

struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  DoubleDouble() = default;
  // A double is a pair whose low word is 0.
  DoubleDouble(double h, double l) : hi(h), lo(l) {
    if (l.place >= 0 || l.value != 0) *this = {proofs::place_of_pair(h, l), h, l};
  }
  DoubleDouble(const TwoDoubles& pair) : DoubleDouble(pair.hi, pair.lo) {}
  DoubleDouble(int place, double h, double l)
      : hi(h.value, proofs::word("High", place, h)), lo(l.value, proofs::word("Low", place, l)) {}

  [[nodiscard]] int place() const { return proofs::place_of_pair(hi, lo); }
  // The words alone, from which the values of an operation are computed.
  [[nodiscard]] TwoDoubles words() const { return {{hi.value, -1}, {lo.value, -1}}; }
};

inline DoubleDouble remembered(const char* name, std::vector<DoubleDouble> operands,
                               const TwoDoubles& words) {
  std::vector<int> places;
  bool is_traced = false;
  for (const DoubleDouble& operand : operands) {
    is_traced = is_traced || operand.place() >= 0;
    places.push_back(operand.place());
  }
  if (!is_traced) return {-1, words.hi, words.lo};
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 0) places[i] = operands[i].hi.recorded();
  }
  return {proofs::add_operation(name, places, words.hi.value), words.hi, words.lo};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return remembered("Opposite", {a}, -a.words());
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  return remembered("Plus", {a, b}, a.words() + b.words());
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  const TwoDoubles words = a.words() - b.words();
  if (proofs::is_given_pair(a.place()) && proofs::is_given_pair(b.place())) {
    return {proofs::given_pair_of(a.place(), b.place()), words.hi, words.lo};
  }
  return remembered("Minus", {a, b}, words);
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  return remembered("Times", {a, b}, a.words() * b.words());
}
inline DoubleDouble operator*(const DoubleDouble& a, double b) { return a * DoubleDouble{b, 0}; }

}  // namespace rondel::exact
