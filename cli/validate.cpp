// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "validate.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>
#include <type_traits>

#include "double_text.h"
#include "rondel/types.h"

namespace rondel::cli {
namespace {

// Reads a number; false unless it is the whole text. It does not depend on the locale.
template <class Number>
bool parse(const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  if constexpr (std::is_integral_v<Number>) {
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end;
  } else {
    const auto [rest, error] = double_from(text.data(), end, value);
    return error == std::errc() && rest == end;
  }
}

}  // namespace

std::string finite_error(const std::string& text) {
  double value = 0;
  if (!parse(text, value)) return "'" + text + "' is not a number";
  return std::isfinite(value) ? std::string() : "'" + text + "' is not finite";
}

std::optional<std::pair<std::string, std::string>> parts_at_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find(',', comma + 1) != std::string_view::npos) {
    return std::nullopt;
  }
  return std::pair(std::string(text.substr(0, comma)), std::string(text.substr(comma + 1)));
}

std::string positive_error(const std::string& text) {
  std::string error = finite_error(text);
  if (!error.empty()) return error;
  double value = 0;
  parse(text, value);
  return value > 0 ? std::string() : "'" + text + "' is not positive";
}

std::string range_error(const std::string& text, double min, double max) {
  std::string error = finite_error(text);
  if (!error.empty()) return error;
  double value = 0;
  parse(text, value);
  if (min <= value && value <= max) return {};
  char range[64];
  std::snprintf(range, sizeof range, "' is not from %g to %g", min, max);
  return "'" + text + range;
}

std::string digits_of_whole(std::string text) {
  double value = 0;
  const bool is_digits = text.find_first_of(".eE") == std::string::npos;
  if (is_digits || !parse(text, value)) return text;
  const bool is_whole = value >= 0 && value <= 0x1p53 && value == std::floor(value);
  return is_whole ? std::to_string(static_cast<std::uint64_t>(value)) : text;
}

std::string whole_error(const std::string& text, std::uint64_t min, std::uint64_t max) {
  std::uint64_t value = 0;
  const bool is_octal = text.size() > 1 && text.front() == '0';  // the parser that follows would
                                                                 // take it for octal
  if (!is_octal && parse(text, value) && min <= value && value <= max) return {};
  return "'" + text + "' is not a whole number from " + std::to_string(min) + " to " +
         std::to_string(max);
}

namespace {

// Returns the number of bytes, or 0 if the text is not valid. A fraction needs a unit: 1.5 bytes
// are a forgotten unit.
std::uint64_t parsed_bytes(const std::string& text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::string number = text.substr(0, end);
  unsigned bits = 0;
  if (end < text.size()) {
    const std::size_t unit = std::string_view("KkMmGgTt").find(text[end]);
    if (unit == std::string_view::npos || end + 1 < text.size()) return 0;
    bits = 10 * (static_cast<unsigned>(unit / 2) + 1);
  }
  if (whole_error(number, 1, std::numeric_limits<std::uint64_t>::max() >> bits).empty())
    return std::stoull(number) << bits;
  double value = 0;
  if (bits == 0 || number.find('.') == std::string::npos || !parse(number, value)) return 0;
  value = std::ldexp(value, static_cast<int>(bits));
  return value < 0x1p64 ? static_cast<std::uint64_t>(value) : 0;
}

}  // namespace

std::string bytes_error(const std::string& text) {
  if (parsed_bytes(text) != 0) return {};
  return "'" + text + "' is not a number of bytes, as 2G or 500M";
}

std::uint64_t bytes_of(const std::string& text) { return parsed_bytes(text); }

std::string count_error(const std::string& text) { return whole_error(text, 1, max_sites); }

std::string seed_error(const std::string& text) {
  return whole_error(text, 0, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace rondel::cli
