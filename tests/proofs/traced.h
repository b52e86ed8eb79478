// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A number that remembers how it was computed. The headers of the predicates are compiled once more
// with it in place of double, so that what is written down is the formula that is compiled.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace rondel::proofs {

// An operation and its operands, as places in the list of all operations.
struct Operation {
  // Given, Constant, Opposite, Absolute, Scaled, Plus, Minus, Times, Quotient, Root, Largest, Least; Pair,
  // a pair of doubles that is given; High and Low, the words of a pair; Word, a given word of one.
  std::string name;
  std::vector<int> operands;
  double value = 0;
};

struct Comparison {
  int left = 0;
  int right = 0;
  bool is_greater = false;
};

inline std::vector<Operation> operations;
inline std::vector<Comparison> comparisons;

// Where a ladder asks its next rung.
struct NextRung {};

// Asked for the outcome of a comparison, in place of the numbers.
inline std::function<bool(const Comparison&)> outcome;

inline int add_operation(std::string name, std::vector<int> operands, double value) {
  operations.push_back({std::move(name), std::move(operands), value});
  return static_cast<int>(operations.size()) - 1;
}

// Constants of the code are computed by the compiler, and have no place until they are used. A power of two
// that is made of its bits has a place of its own kind: a product with it is not rounded.
inline constexpr int power_of_two = -2;

struct Number {
  double value = 0;
  int place = -1;

  Number() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr Number(T v) : value(static_cast<double>(v)) {}
  constexpr Number(double v, int p) : value(v), place(p) {}

  [[nodiscard]] int recorded() const {
    return place >= 0 ? place : add_operation("Constant", {}, value);
  }
  explicit constexpr operator int() const { return static_cast<int>(value); }
};

constexpr Number combined(const char* name, const Number& a, const Number& b, double value) {
  if (std::is_constant_evaluated() || (a.place < 0 && b.place < 0)) return {value, -1};
  return {value, add_operation(name, {a.recorded(), b.recorded()}, value)};
}
constexpr Number combined(const char* name, const Number& a, double value) {
  if (std::is_constant_evaluated() || a.place < 0) return {value, -1};
  return {value, add_operation(name, {a.place}, value)};
}

constexpr Number operator+(const Number& a, const Number& b) {
  return combined("Plus", a, b, a.value + b.value);
}
constexpr Number operator-(const Number& a, const Number& b) {
  return combined("Minus", a, b, a.value - b.value);
}
constexpr Number operator*(const Number& a, const Number& b) {
  if (a.place == power_of_two && b.place >= 0) return combined("Scaled", b, a.value * b.value);
  if (b.place == power_of_two && a.place >= 0) return combined("Scaled", a, a.value * b.value);
  return combined("Times", a, b, a.value * b.value);
}
constexpr Number operator/(const Number& a, const Number& b) {
  return combined("Quotient", a, b, a.value / b.value);
}
constexpr Number operator-(const Number& a) { return combined("Opposite", a, -a.value); }
constexpr Number& operator+=(Number& a, const Number& b) { return a = a + b; }
constexpr Number& operator*=(Number& a, const Number& b) { return a = a * b; }

inline Number last_taken_apart;

constexpr bool compared(const Number& a, const Number& b, bool is_greater) {
  if (std::is_constant_evaluated() || (a.place < 0 && b.place < 0)) return is_greater;
  comparisons.push_back({a.recorded(), b.recorded(), is_greater});
  return outcome ? outcome(comparisons.back()) : is_greater;
}
constexpr bool operator>(const Number& a, const Number& b) {
  return compared(a, b, a.value > b.value);
}
constexpr bool operator<(const Number& a, const Number& b) { return b > a; }
constexpr bool operator<=(const Number& a, const Number& b) { return !(a > b); }
constexpr bool operator>=(const Number& a, const Number& b) { return !(b > a); }
constexpr bool operator==(const Number& a, const Number& b) { return a.value == b.value; }
// What the test for numbers of 64 bits asks: yes, so that their formulas are recorded.
inline Number operator+(const volatile Number& a, const volatile Number& /*b*/) {
  return {2 * a.value, -1};
}
inline bool operator!=(const Number& a, const volatile Number& b) { return a.value != b.value; }

// --- pairs of doubles (exact/eft.h) ---

inline std::map<std::pair<int, int>, int> given_pairs;

// The given pair of two places: of its words, or of two given pairs whose difference it is.
inline int given_pair_of(int a, int b) {
  const auto [found, is_new] = given_pairs.try_emplace({a, b}, -1);
  if (is_new) found->second = add_operation("Pair", {}, 0);
  return found->second;
}

inline const Operation* operation_at(int place) {
  return place < 0 ? nullptr : &operations[static_cast<std::size_t>(place)];
}
inline bool is_given_pair(int place) {
  const Operation* operation = operation_at(place);
  return operation != nullptr && operation->name == "Pair";
}

// -1 for a constant. A double is a pair whose low word is 0.
inline int place_of_pair(const Number& hi, const Number& lo) {
  if (lo.place < 0 && lo.value == 0) return hi.place;
  const Operation* high = operation_at(hi.place);
  const Operation* low = operation_at(lo.place);
  if (high != nullptr && low != nullptr && high->name == "High" && low->name == "Low" &&
      high->operands == low->operands)
    return high->operands[0];
  return hi.place < 0 && lo.place < 0 ? -1 : given_pair_of(hi.recorded(), lo.recorded());
}

// The place of a word of a pair.
inline int word(const char* name, int place, const Number& value) {
  const Operation* pair = operation_at(place);
  if (pair == nullptr || value.place == place) return value.place;
  const Operation* known = operation_at(value.place);
  if (known != nullptr && known->name == name && known->operands[0] == place) return value.place;
  return add_operation(name, {place}, value.value);
}

}  // namespace rondel::proofs

// What the code asks of the standard library for a double.
namespace std {
constexpr rondel::proofs::Number max(const rondel::proofs::Number& a,
                                     const rondel::proofs::Number& b) {
  return rondel::proofs::combined("Largest", a, b, a.value < b.value ? b.value : a.value);
}
constexpr rondel::proofs::Number min(const rondel::proofs::Number& a,
                                     const rondel::proofs::Number& b) {
  return rondel::proofs::combined("Least", a, b, b.value < a.value ? b.value : a.value);
}
constexpr rondel::proofs::Number abs(const rondel::proofs::Number& a) {
  return rondel::proofs::combined("Absolute", a, a.value < 0 ? -a.value : a.value);
}
inline rondel::proofs::Number sqrt(const rondel::proofs::Number& a) {
  return rondel::proofs::combined("Root", a, sqrt(a.value));
}
inline rondel::proofs::Number ldexp(const rondel::proofs::Number& a, int e) {
  return {ldexp(a.value, e), -1};
}
inline int ilogb(const rondel::proofs::Number& a) { return ilogb(a.value); }
inline bool isfinite(const rondel::proofs::Number& a) { return isfinite(a.value); }
template <>
struct numeric_limits<rondel::proofs::Number> : numeric_limits<double> {
  static constexpr int digits = 64;  // so that the formulas for 64 bits are recorded, too
};
template <class To, class From>
requires same_as<From, rondel::proofs::Number>
constexpr To bit_cast(const From& a) noexcept {
  if (!is_constant_evaluated() && a.place >= 0) rondel::proofs::last_taken_apart = a;
  return bit_cast<To>(a.value);
}
template <class To, class From>
requires same_as<To, rondel::proofs::Number>
constexpr To bit_cast(const From& a) noexcept {
  // A number with the digits of the last one that was taken apart is that one, scaled.
  const auto digits = bit_cast<uint64_t>(a) << 12U;
  if (digits == 0) return {bit_cast<double>(a), rondel::proofs::power_of_two};
  const rondel::proofs::Number& last = rondel::proofs::last_taken_apart;
  if (bit_cast<uint64_t>(last.value) << 12U != digits) abort();
  return rondel::proofs::combined("Scaled", last, bit_cast<double>(a));
}
}  // namespace std
