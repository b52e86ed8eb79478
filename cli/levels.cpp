// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "levels.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "command.h"
#include "double_text.h"
#include "validate.h"

namespace rondel::cli {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Returns the texts between the commas, empty ones as well; none of an empty text.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Returns the number in a text that finite_error() accepts; double_from() does not know a plus sign.
double number_of(const std::string& text) {
  double value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double_from(begin, text.data() + text.size(), value);
  return value;
}

// Rounding to 15 digits removes the error of a product: 3 * 0.1 is 0.30000000000000004, but the level
// is 0.3. What rounding moves by more than that error, two units in the last place, has more digits.
double rounded_to_15_digits(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 15)
          .ptr;
  double rounded = value;
  double_from(text.data(), end, rounded);
  const double unit = std::nextafter(std::abs(value), infinity) - std::abs(value);
  if (std::abs(rounded - value) > 2 * unit) rounded = value;
  return rounded + 0.0;  // turns -0 into 0
}

}  // namespace

std::string levels_error(const std::string& text) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.empty()) return "there is no level";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) return "there is an empty level in '" + text + "'";
    std::string error = finite_error(parts[i]);
    if (!error.empty()) return error;
    if (i > 0 && !(number_of(parts[i - 1]) < number_of(parts[i]))) {
      return "'" + parts[i] + "' is not above '" + parts[i - 1] + "'";
    }
  }
  return {};
}

std::vector<double> levels_of(const std::string& text) {
  std::vector<double> levels;
  for (const std::string& part : parts_of(text)) levels.push_back(number_of(part));
  return levels;
}

std::vector<double> levels_at(double step, std::span<const double> values,
                              const std::string& option) {
  // More levels than this are a step in the wrong unit rather than a map.
  constexpr double most = 10'000;
  // Beyond as many steps two multiples of a step may be one double.
  constexpr double most_steps = 0x1p53;
  double least = infinity;
  double largest = -infinity;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  if (!(least < largest)) return {};
  if (!(largest / step - least / step <= most)) {
    throw UsageError(option + ": there would be more than 10000 levels");
  }
  if (std::max(std::abs(least), std::abs(largest)) / step >= most_steps) {
    throw UsageError(option + ": the step is too small for values this large");
  }
  std::vector<double> levels;
  for (double k = std::floor(least / step); k <= std::ceil(largest / step); ++k) {
    const double level = rounded_to_15_digits(k * step);
    if (least < level && level <= largest && (levels.empty() || levels.back() < level)) {
      levels.push_back(level);
    }
  }
  return levels;
}

}  // namespace rondel::cli
