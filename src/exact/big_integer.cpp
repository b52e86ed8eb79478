// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/big_integer.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rondel::exact {
namespace {

using Magnitude64 = std::vector<Word>;

std::strong_ordering compare_magnitudes(const Magnitude64& a, const Magnitude64& b) {
  if (a.size() != b.size()) return a.size() <=> b.size();
  for (std::size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] <=> b[i];
  }
  return std::strong_ordering::equal;
}

void add_magnitude(Magnitude64& a, const Magnitude64& b) {
  if (a.size() < b.size()) a.resize(b.size());
  Word carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (i >= b.size() && carry == 0) return;
    const Word term = i < b.size() ? b[i] : 0;
    const Word sum = a[i] + term;
    a[i] = sum + carry;
    carry = static_cast<Word>(sum < term) + static_cast<Word>(a[i] < sum);
  }
  if (carry != 0) a.push_back(carry);
}

// Sets a to large - small, where a is one of the two.
void subtract_magnitudes(const Magnitude64& large, const Magnitude64& small, Magnitude64& a) {
  const std::size_t size = large.size();
  const std::size_t size_of_small = small.size();
  a.resize(size);
  Word borrow = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Word first = large[i];
    const Word second = i < size_of_small ? small[i] : 0;
    const Word difference = first - second;
    a[i] = difference - borrow;
    borrow = static_cast<Word>(first < second) + static_cast<Word>(difference < borrow);
  }
}

// Division is done in digits of 32 bits, whose products every machine has.
using Digit = std::uint32_t;
constexpr unsigned digit_bits = 32;
constexpr std::uint64_t digit_range = std::uint64_t{1} << digit_bits;

std::vector<Digit> digits_of(const Magnitude64& words) {
  std::vector<Digit> digits;
  digits.reserve(2 * words.size() + 1);
  for (const Word word : words) {
    digits.push_back(static_cast<Digit>(word));
    digits.push_back(static_cast<Digit>(word >> digit_bits));
  }
  while (!digits.empty() && digits.back() == 0) digits.pop_back();
  return digits;
}

Magnitude64 words_of(const std::vector<Digit>& digits) {
  Magnitude64 words((digits.size() + 1) / 2);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    words[i / 2] |= Word{digits[i]} << (i % 2 * digit_bits);
  }
  return words;
}

// A digit of the quotient of the leading three digits of u by the leading two of v, at most one too
// large for all of v.
std::uint64_t guess_digit(const Digit* u, Digit first, Digit second) {
  const std::uint64_t leading = u[2] * digit_range + u[1];
  std::uint64_t quotient = leading / first;
  std::uint64_t rest = leading % first;
  while (quotient >= digit_range || quotient * second > rest * digit_range + u[0]) {
    --quotient;
    rest += first;
    if (rest >= digit_range) break;
  }
  return quotient;
}

// Subtracts quotient v from the digits at u, one more than v has. True if that was too much.
bool subtract_product(Digit* u, const std::vector<Digit>& v, std::uint64_t quotient) {
  std::uint64_t carry = 0;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i <= v.size(); ++i) {
    const std::uint64_t product = (i < v.size() ? quotient * v[i] : 0) + carry;
    carry = product >> digit_bits;
    const std::uint64_t difference = u[i] - (product % digit_range) - borrow;
    u[i] = static_cast<Digit>(difference);
    borrow = difference >> 63U;
  }
  return borrow != 0;
}

void add_back(Digit* u, const std::vector<Digit>& v) {
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i <= v.size(); ++i) {
    carry += std::uint64_t{u[i]} + (i < v.size() ? v[i] : 0);
    u[i] = static_cast<Digit>(carry);
    carry >>= digit_bits;
  }
}

// Knuth, The Art of Computer Programming, volume 2, section 4.3.1, algorithm D: returns u / v and
// leaves the remainder in u. Preconditions: u has a leading zero, v has two digits or more and its
// highest bit set, and u is at least as long as v.
std::vector<Digit> divide_digits(std::vector<Digit>& u, const std::vector<Digit>& v) {
  const std::size_t n = v.size();
  std::vector<Digit> quotient(u.size() - n);
  for (std::size_t j = quotient.size(); j-- > 0;) {
    std::uint64_t digit = guess_digit(&u[j + n - 2], v[n - 1], v[n - 2]);
    if (subtract_product(&u[j], v, digit)) {
      --digit;
      add_back(&u[j], v);
    }
    quotient[j] = static_cast<Digit>(digit);
  }
  return quotient;
}

}  // namespace

Integer::Integer(std::int64_t value) : is_negative_(value < 0) {
  const auto bits = static_cast<Word>(value);
  if (value != 0) words_.push_back(value < 0 ? Word{0} - bits : bits);
}

unsigned Integer::num_bits() const {
  if (words_.empty()) return 0;
  return static_cast<unsigned>(64 * words_.size()) -
         static_cast<unsigned>(std::countl_zero(words_.back()));
}

unsigned Integer::trailing_zeros() const {
  std::size_t i = 0;
  while (words_[i] == 0) ++i;
  return static_cast<unsigned>(64 * i) + static_cast<unsigned>(std::countr_zero(words_[i]));
}

void Integer::trim() {
  while (!words_.empty() && words_.back() == 0) words_.pop_back();
  if (words_.empty()) is_negative_ = false;
}

Integer Integer::operator-() const {
  Integer result = *this;
  result.is_negative_ = !is_negative_ && !words_.empty();
  return result;
}

Integer abs(Integer a) {
  a.is_negative_ = false;
  return a;
}

Integer& Integer::operator+=(const Integer& b) {
  if (b.words_.empty()) return *this;
  if (is_negative_ == b.is_negative_ || words_.empty()) {
    is_negative_ = b.is_negative_;
    add_magnitude(words_, b.words_);
  } else if (compare_magnitudes(words_, b.words_) > 0) {
    subtract_magnitudes(words_, b.words_, words_);
  } else {
    is_negative_ = b.is_negative_;
    subtract_magnitudes(b.words_, words_, words_);
  }
  trim();
  return *this;
}

Integer operator*(const Integer& a, const Integer& b) {
  Integer product;
  const std::size_t size = b.words_.size();
  product.words_.resize(a.words_.size() + size);
  // Words of 0 cost next to nothing: scaled doubles have many.
  std::size_t first = 0;
  while (first < size && b.words_[first] == 0) ++first;
  for (std::size_t i = 0; i < a.words_.size(); ++i) {
    if (a.words_[i] == 0) continue;
    Word carry = 0;
    for (std::size_t j = first; j < size; ++j) {
      const TwoWords t = multiply_and_add(a.words_[i], b.words_[j], product.words_[i + j], carry);
      product.words_[i + j] = t.low;
      carry = t.high;
    }
    product.words_[i + size] = carry;
  }
  product.is_negative_ = a.is_negative_ != b.is_negative_;
  product.trim();
  return product;
}

Integer operator<<(const Integer& a, unsigned bits) {
  if (a.words_.empty()) return a;
  const std::size_t whole = bits / 64;
  const unsigned part = bits % 64;
  Integer result;
  result.is_negative_ = a.is_negative_;
  result.words_.resize(a.words_.size() + whole + 1);
  for (std::size_t i = 0; i < a.words_.size(); ++i) {
    result.words_[i + whole] |= a.words_[i] << part;
    if (part != 0) result.words_[i + whole + 1] = a.words_[i] >> (64 - part);
  }
  result.trim();
  return result;
}

Integer operator>>(const Integer& a, unsigned bits) {
  const std::size_t whole = bits / 64;
  const unsigned part = bits % 64;
  Integer result;
  if (whole >= a.words_.size()) return result;
  result.is_negative_ = a.is_negative_;
  result.words_.assign(a.words_.begin() + static_cast<std::ptrdiff_t>(whole), a.words_.end());
  for (std::size_t i = 0; part != 0 && i < result.words_.size(); ++i) {
    const Word next = i + 1 < result.words_.size() ? result.words_[i + 1] << (64 - part) : 0;
    result.words_[i] = result.words_[i] >> part | next;
  }
  result.trim();
  return result;
}

Integer low_bits(Integer a, unsigned bits) {
  a.is_negative_ = false;
  const std::size_t whole = bits / 64;
  if (whole < a.words_.size()) {
    a.words_[whole] &= (Word{1} << (bits % 64)) - 1;
    a.words_.resize(whole + 1);
  }
  a.trim();
  return a;
}

std::strong_ordering operator<=>(const Integer& a, const Integer& b) {
  if (a.sign() != b.sign()) return a.sign() <=> b.sign();
  return a.is_negative_ ? compare_magnitudes(b.words_, a.words_)
                        : compare_magnitudes(a.words_, b.words_);
}

std::pair<Integer, Integer> divide(const Integer& a, const Integer& b) {
  // Both are shifted until the divisor begins with a bit of 1 and has two digits or more.
  const unsigned length = b.num_bits();
  const unsigned shift =
      (digit_bits - length % digit_bits) % digit_bits + (length <= digit_bits ? digit_bits : 0);
  std::vector<Digit> u = digits_of((a << shift).words_);
  const std::vector<Digit> v = digits_of((b << shift).words_);
  if (u.size() < v.size()) return {Integer(), a};
  u.push_back(0);
  Integer quotient;
  quotient.words_ = words_of(divide_digits(u, v));
  quotient.is_negative_ = a.is_negative_ != b.is_negative_;
  quotient.trim();
  Integer remainder;
  remainder.words_ = words_of(u);
  remainder.is_negative_ = a.is_negative_;
  remainder.trim();
  return {std::move(quotient), remainder >> shift};
}

}  // namespace rondel::exact
