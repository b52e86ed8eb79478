// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads and writes numbers as text, and checks coordinates and indices.
//
// in    text of files, or numbers
// out   numbers, with the message of BadValue if there is none; or text
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
#include "rondel/types.h"

namespace rondel::io {

// Returns the finite number in `field`; blanks around it and a leading plus are allowed. `what`
// names it in the message of BadValue: `longitude "12,5" is not a number`.
double parse_number(std::string_view field, std::string_view what);

// Returns the integer in `field`; blanks around it are allowed. `what` is as above.
std::int64_t parse_integer(std::string_view field, std::string_view what);

// Returns the index of a site, which a file may hold as any integer. Throws BadValue if it is not
// one.
template <std::integral Integer>
Index checked_index(Integer value) {
  if (value < 0) throw BadValue("negative index " + std::to_string(value));
  if (static_cast<std::make_unsigned_t<Integer>>(value) > std::numeric_limits<Index>::max()) {
    throw BadValue("index " + std::to_string(value) + " is too large");
  }
  return static_cast<Index>(value);
}

// Returns the number as a double. Throws BadValue for integers of 64 bits that are no doubles.
template <typename Number>
double exact_double(Number value) {
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8) {
    constexpr int max_bits = std::numeric_limits<double>::digits;
    const auto bits = static_cast<std::uint64_t>(value);
    const std::uint64_t magnitude = value < 0 ? 0 - bits : bits;
    if (magnitude != 0 && magnitude >> std::countr_zero(magnitude) >> max_bits != 0) {
      throw BadValue(std::to_string(value) + " is no double");
    }
  }
  return static_cast<double>(value);
}

// Appends the shortest digits that give back the same bits.
void append_number(std::string& out, double value);
void append_integer(std::string& out, std::uint64_t value);

// True if JSON accepts `text` as a number (RFC 8259, section 6).
bool is_json_number(std::string_view text);

// Returns text from a file for a message: on one line, at most `longest` bytes, in UTF-8 and
// without control characters.
std::string one_line(std::string_view text, std::size_t longest);
// Returns one_line() of a value, at most 60 bytes, in quotes.
std::string in_quotes(std::string_view value);

// Returns the position in degrees of a longitude and latitude, given in degrees or radians. Throws
// BadValue if they are not finite or the latitude lies beyond a pole.
LonLat checked_position(double lon, double lat, bool is_radians);

// Returns the angular radius in degrees of a circle, given in degrees or radians. Throws BadValue
// unless it is at least 0 and less than 90 degrees.
double checked_radius(double radius, bool is_radians);

// Returns `point`; throws BadValue if it is not finite.
Point checked_point(const Point& point);

// Returns the text without the blanks and tabs around it.
std::string_view trim(std::string_view text);

// The room that write_number() needs; the longest double has 24 characters:
// -2.2250738585072014e-308
inline constexpr int number_room = 32;

// Writes the shortest digits that give back the same bits, as std::to_chars does, and returns their
// end; fast, since text files consist of little else. `out` has room for number_room bytes, all of
// which may change.
char* write_number(char* out, double value);

}  // namespace rondel::io
