// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/number.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "io/utf8.h"

namespace rondel::io {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Skips one or more digits; returns false if there are none.
bool skip_digits(const char*& p, const char* end) {
  const char* const start = p;
  while (p != end && is_digit(*p)) ++p;
  return p != start;
}

// Returns the shortest digits of a number, for messages.
std::string text_of(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

// Throws BadValue for infinite numbers and NaN; `what` names the number.
void require_finite(double value, std::string_view what) {
  if (!std::isfinite(value)) {
    throw BadValue(std::string(what) + " " + text_of(value) + " is not finite");
  }
}

// True if the text looks like a number with a comma in place of the point.
bool has_decimal_comma(std::string_view digits) {
  const std::size_t comma = digits.find(',');
  if (comma == std::string_view::npos || comma + 1 == digits.size()) return false;
  return is_json_number(digits.substr(0, comma)) &&
         std::ranges::all_of(digits.substr(comma + 1), is_digit);
}

}  // namespace

std::string_view trim(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

double parse_number(std::string_view field, std::string_view what) {
  std::string_view digits = trim(field);
  if (digits.empty()) throw BadValue(std::string(what) + " is empty");
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = fast_float::from_chars(digits.data(), end, value);
  const bool is_number = stop == end && error != std::errc::invalid_argument;
  if (is_number && std::isfinite(value)) return value;
  throw BadValue(std::string(what) + " " + in_quotes(trim(field)) +
                 (is_number
                      ? (std::ranges::any_of(digits, is_digit) ? " is beyond the largest number"
                                                               : " is not finite")
                  : has_decimal_comma(digits) ? " is not a number: its decimal point is a comma"
                                              : " is not a number"));
}

std::int64_t parse_integer(std::string_view field, std::string_view what) {
  const std::string_view digits = trim(field);
  std::int64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (stop != end || error != std::errc{}) {
    throw BadValue(std::string(what) + " " + in_quotes(digits) + " is not an integer");
  }
  return value;
}

void append_number(std::string& out, double value) {
  std::array<char, number_room> digits;
  out.append(digits.data(), write_number(digits.data(), value));
}

void append_integer(std::string& out, std::uint64_t value) {
  std::array<char, 20> digits;  // 2^64 has 20
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), result.ptr);
}

bool is_json_number(std::string_view text) {
  const char* p = text.data();
  const char* const end = p + text.size();
  if (p != end && *p == '-') ++p;
  if (p == end) return false;
  if (*p == '0') {
    ++p;
  } else if (!skip_digits(p, end)) {
    return false;
  }
  if (p != end && *p == '.' && !skip_digits(++p, end)) return false;
  if (p != end && (*p == 'e' || *p == 'E')) {
    ++p;
    if (p != end && (*p == '+' || *p == '-')) ++p;
    if (!skip_digits(p, end)) return false;
  }
  return p == end;
}

std::string one_line(std::string_view text, std::size_t longest) {
  std::string line(text.substr(0, longest));
  if (text.size() > longest) {
    // Does not cut a UTF-8 sequence: drops its bytes 10xxxxxx and then its first byte.
    while (!line.empty() && (line.back() & 0xC0) == 0x80) line.pop_back();
    if (!line.empty() && (line.back() & 0x80) != 0) line.pop_back();
    line += "...";
  }
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::replace_if(line.begin(), line.end(), is_control, '?');
  if (!is_utf8(line)) {
    const auto is_not_ascii = [](char c) { return (c & 0x80) != 0; };
    std::replace_if(line.begin(), line.end(), is_not_ascii, '?');
  }
  return line;
}

std::string in_quotes(std::string_view value) { return '"' + one_line(value, 60) + '"'; }

LonLat checked_position(double lon, double lat, bool is_radians) {
  require_finite(lon, "longitude");
  require_finite(lat, "latitude");
  if (!is_radians) {
    if (std::abs(lat) > 90) {
      throw BadValue("latitude " + text_of(lat) + " is outside [-90, 90]");
    }
    return {lon, lat};
  }
  // Half of pi as a double, times this, is exactly 90. A latitude that is up to four ulp beyond the
  // pole counts as the pole.
  constexpr double limit = std::numbers::pi / 2 + 4 * std::numeric_limits<double>::epsilon();
  if (std::abs(lat) > limit) {
    throw BadValue("latitude " + text_of(lat) + " is outside [-pi/2, pi/2]");
  }
  const double lon_deg = lon * degrees_per_radian;
  if (!std::isfinite(lon_deg)) {
    throw BadValue("longitude " + text_of(lon) + " is too large for degrees");
  }
  return {lon_deg, std::clamp(lat * degrees_per_radian, -90.0, 90.0)};
}

double checked_radius(double radius, bool is_radians) {
  const double degrees = is_radians ? radius * degrees_per_radian : radius;
  if (degrees >= 0 && degrees < 90) return degrees;
  throw BadValue("radius " + text_of(radius) + " is not in [0, " + (is_radians ? "pi/2)" : "90)"));
}

Point checked_point(const Point& point) {
  require_finite(point.x, "x");
  require_finite(point.y, "y");
  require_finite(point.z, "z");
  return point;
}

}  // namespace rondel::io
