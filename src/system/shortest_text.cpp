// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "system/message_text.h"

namespace rondel::system {

namespace {

constexpr int max_digits = 17;  // that tell any two doubles apart

std::string printed(const char* format, int precision, double value) {
  std::array<char, 400> buffer{};  // 1.8e308 in full
  std::snprintf(buffer.data(), buffer.size(), format, precision, value);
  return buffer.data();
}

}  // namespace

std::string shortest_text_without_tables(double value) {
  if (std::isnan(value)) return std::signbit(value) ? "-nan" : "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  int decimals = 0;
  std::string scientific;
  do {
    scientific = printed("%.*e", decimals++, value);
  } while (decimals < max_digits && std::strtod(scientific.c_str(), nullptr) != value);
  const int exponent = std::atoi(scientific.c_str() + scientific.find('e') + 1);
  if (std::abs(exponent) > max_digits + 8) return scientific;  // longer otherwise
  const std::string fixed = printed("%.*f", std::max(0, decimals - 1 - exponent), value);
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

#if defined(__wasm__)
std::string shortest_text(double value) { return shortest_text_without_tables(value); }
#else
std::string shortest_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}
#endif

}  // namespace rondel::system
