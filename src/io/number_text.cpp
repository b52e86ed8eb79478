// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the shortest digits of doubles. A double v = m 2^e, m < 2^53, is the double nearest to
// all decimals within half of 2^e. For exponents of usual coordinates all of the following is exact
// in two words. With the least s for which 10^-s <= 2^e, and D = -e - s,
//
//     10^s v = m 5^s / 2^D,     10^s 2^e / 2 = (5^s / 2) / 2^D,     1 <= 5^s / 2^D < 10.
//
// So in units of 10^-s the decimals around v are an interval whose length is between 1 and 10: it
// contains an integer, and at most one multiple of 10. That multiple, without its zeros, is the
// shortest decimal; if there is none, the integer nearest to 10^s v is. At a power of 2 the
// interval is not symmetric; std::to_chars handles that and all other exponents.
#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "exact/words.h"
#include "io/number.h"

namespace rondel::io {
namespace {

using exact::Word;

// The exponents of numbers from 2^-30 to 2^30, for which 5^s < 2^59 and 10 * 2^(D + 1) < 2^62.
constexpr int min_exponent = -82;
constexpr int greatest_exponent = -23;

// The factor of numbers with one exponent, as above.
struct Scale {
  Word power_of_5 = 1;    // 5^s
  int decimals = 0;       // s
  unsigned fraction = 0;  // D
};

// The scales of all these exponents, computed by the compiler.
constexpr auto scales = [] {
  std::array<Scale, greatest_exponent - min_exponent + 1> all{};
  Scale scale;
  for (int e = greatest_exponent; e >= min_exponent; --e) {
    scale.fraction = static_cast<unsigned>(-e - scale.decimals);
    while (scale.power_of_5 < Word{1} << scale.fraction) {
      scale.power_of_5 *= 5;
      ++scale.decimals;
      --scale.fraction;
    }
    all[static_cast<std::size_t>(e - min_exponent)] = scale;
  }
  return all;
}();

// Returns the shortest decimal of m 2^e, in units of 10^-s.
// Precondition: m is between 2^52 and 2^53.
Word shortest_decimal(Word m, const Scale& scale) {
  const exact::TwoWords product = exact::multiply_and_add(m, scale.power_of_5, 0, 0);
  const unsigned d = scale.fraction;
  const Word whole = product.high << (64 - d) | product.low >> d;
  // Computes in units of 2^-(D + 1), in which half of the interval is 5^s. That is odd and
  // everything else is even, so that nothing lies at an end of the interval.
  const Word one = Word{2} << d;
  const Word rest = 2 * (product.low & ((Word{1} << d) - 1));
  const Word half = scale.power_of_5;
  const Word last_digit = whole % 10;
  const Word below = last_digit * one + rest;
  if (below <= half) return whole - last_digit;
  if (10 * one - below <= half) return whole - last_digit + 10;
  const bool is_up = 2 * rest > one || (2 * rest == one && (whole & 1) != 0);
  return whole + (is_up ? 1 : 0);
}

// The digits "00", "01", ... "99".
constexpr auto digit_pairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}();

void write_pair(char* out, std::uint32_t value) {
  std::memcpy(out, digit_pairs.data() + std::size_t{2} * value, 2);
}

// Writes eight digits, with leading zeros.
void write_eight(char* out, std::uint32_t value) {
  const std::uint32_t high = value / 10000;
  const std::uint32_t low = value % 10000;
  write_pair(out, high / 100);
  write_pair(out + 2, high % 100);
  write_pair(out + 4, low / 100);
  write_pair(out + 6, low % 100);
}

constexpr int num_digits = 17;

// The digits of a number below 10^17, filled up with '0'.
struct Digits {
  explicit Digits(Word number) {
    constexpr Word eight = 100'000'000;
    const Word high = number / eight;
    text[0] = static_cast<char>('0' + high / eight);
    write_eight(text.data() + 1, static_cast<std::uint32_t>(high % eight));
    write_eight(text.data() + 9, static_cast<std::uint32_t>(number % eight));
    while (text[static_cast<std::size_t>(count - 1)] == '0') --count;
  }

  std::array<char, num_digits> text{};
  int count = num_digits;  // without trailing zeros
};

char* copy(char* out, const char* text, int count) {
  std::memcpy(out, text, static_cast<std::size_t>(count));
  return out + count;
}

// Writes "1.25e-05", or "2e-05" for one digit.
char* write_scientific(char* out, const Digits& digits, int exponent) {
  *out++ = digits.text[0];
  if (digits.count > 1) {
    *out++ = '.';
    out = copy(out, digits.text.data() + 1, digits.count - 1);
  }
  *out++ = 'e';
  *out++ = exponent < 0 ? '-' : '+';
  write_pair(out, static_cast<std::uint32_t>(exponent < 0 ? -exponent : exponent));
  return out + 2;
}

// Writes the digits d.ddd times 10^exponent like std::to_chars: without an exponent unless that is
// longer.
char* write_digits(char* out, const Digits& digits, int exponent) {
  const char* const text = digits.text.data();
  const int scientific = digits.count + (digits.count > 1 ? 1 : 0) + 4;
  if (exponent < 0) {
    if (digits.count + 1 - exponent > scientific) return write_scientific(out, digits, exponent);
    out = copy(out, "0.000000000", 1 - exponent);
    std::memcpy(out, text, num_digits);
    return out + digits.count;
  }
  const int before_point = exponent + 1;
  if (digits.count <= before_point) {
    if (before_point > scientific) return write_scientific(out, digits, exponent);
    return copy(out, text, before_point);
  }
  out = copy(out, text, before_point);
  *out++ = '.';
  std::memcpy(out, text + before_point, static_cast<std::size_t>(num_digits - before_point));
  return out + (digits.count - before_point);
}

}  // namespace

char* write_number(char* out, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  constexpr std::uint64_t fraction_mask = (std::uint64_t{1} << 52U) - 1;
  const std::uint64_t fraction = bits & fraction_mask;
  const int e = static_cast<int>(bits >> 52U & 0x7FFU) - 1075;
  if (e < min_exponent || e > greatest_exponent || fraction == 0) {
    return std::to_chars(out, out + number_room, value).ptr;
  }
  const Scale& scale = scales[static_cast<std::size_t>(e - min_exponent)];
  Word decimal = shortest_decimal(fraction | (fraction_mask + 1), scale);
  // 10^s v is at least m, so it has 16 or 17 digits.
  constexpr Word min_of_17 = 10'000'000'000'000'000;
  int exponent = num_digits - 1 - scale.decimals;
  if (decimal < min_of_17) {
    decimal *= 10;
    --exponent;
  }
  if ((bits >> 63U) != 0) *out++ = '-';
  return write_digits(out, Digits(decimal), exponent);
}

}  // namespace rondel::io
