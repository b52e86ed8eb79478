// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers as text, and what a coordinate and an index may be.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/bad_value.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::io {

// The finite number in `field`, blanks around it and a leading plus allowed. `what` names it in
// the message: `longitude "12,5" is not a number`.
RONDEL_API double parse_number(std::string_view field, std::string_view what);

// The integer in `field`, blanks around it allowed; `what` as above.
std::int64_t parse_integer(std::string_view field, std::string_view what);

// The index of a site that a file holds as any integer.
template <std::integral Integer>
Index checked_index(Integer value) {
  if (value < 0) throw BadValue("negative index " + std::to_string(value));
  if (static_cast<std::make_unsigned_t<Integer>>(value) > std::numeric_limits<Index>::max()) {
    throw BadValue("index " + std::to_string(value) + " is too large");
  }
  return static_cast<Index>(value);
}

// The number as a double. The doubles nearest to most integers of 64 bits are others: BadValue.
template <typename Number>
double exact_double(Number value) {
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8) {
    constexpr int most_bits = std::numeric_limits<double>::digits;
    const auto bits = static_cast<std::uint64_t>(value);
    const std::uint64_t magnitude = value < 0 ? 0 - bits : bits;
    if (magnitude != 0 && magnitude >> std::countr_zero(magnitude) >> most_bits != 0) {
      throw BadValue(std::to_string(value) + " is no double");
    }
  }
  return static_cast<double>(value);
}

// The shortest digits that give back the same bits.
RONDEL_API void append_number(std::string& out, double value);
void append_integer(std::string& out, std::uint64_t value);

// Whether JSON accepts `text` as a number (RFC 8259, section 6).
bool is_json_number(std::string_view text);

// Text from a file for a message: on one line, at most `longest` bytes, UTF-8 and
// without control characters.
std::string one_line(std::string_view text, std::size_t longest);
// one_line() of a value of at most 60 bytes, in quotes.
RONDEL_API std::string in_quotes(std::string_view value);

// The position in degrees of a longitude and latitude, given in degrees or radians. Throws BadValue
// if they are not finite or the latitude lies beyond a pole.
LonLat checked_position(double lon, double lat, bool is_radians);

// The angular radius in degrees of a circle, given in degrees or radians. Throws BadValue unless it
// is at least 0 and less than a right angle.
double checked_radius(double radius, bool is_radians);

// `point` itself; throws BadValue if it is not finite.
Point checked_point(const Point& point);

// Without the blanks and tabs around it.
RONDEL_API std::string_view trim(std::string_view text);

}  // namespace rondel::io
