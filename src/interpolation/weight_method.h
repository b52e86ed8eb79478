// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the name of a method says about its weights, and how far sums of them may be off.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace rondel::interpolation {

// A sum may differ from the wanted one by the first number, and by the rounding errors of as many
// areas as it has terms, relative to the area of the cell.
constexpr double min_tolerance = 1e-9;
constexpr double error_of_area = 8 * std::numbers::pi * 0x1p-52;

// Returns how far the sum of a row or column of `num_entries` may be off. Without areas, or for an
// area that is none, this is the least tolerance.
inline double tolerance_of(std::size_t num_entries, const std::vector<double>& areas,
                           std::size_t cell, double least = min_tolerance) {
  const double area = areas.empty() ? 0 : areas[cell];
  if (!(area > 0)) return least;
  return least + static_cast<double>(num_entries + 1) * error_of_area / area;
}

inline std::string in_lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

inline bool has_word(const std::string& text, std::string_view word) {
  return text.find(word) != std::string::npos;
}

// The properties of weights that the name of their method implies.
struct MethodFacts {
  explicit MethodFacts(const std::string& method) {
    const std::string name = in_lower_case(method);
    is_conservative = has_word(name, "conserv");
    is_second_order = has_word(name, "second") || has_word(name, "2nd") ||
                      has_word(name, "higher") || has_word(name, "order 2");
    constexpr std::array<std::string_view, 5> averages = {"nearest", "linear", "laplace", "sibson",
                                                          "largest"};
    const bool is_average = std::ranges::any_of(
        averages, [&](std::string_view word) { return name.starts_with(word); });
    constexpr std::array<std::string_view, 6> between = {"bilinear", "cubic",    "hermite",
                                                         "patch",    "distance", "nearest"};
    is_of_points =
        !is_conservative && (is_average || std::ranges::any_of(between, [&](std::string_view word) {
                               return has_word(name, word);
                             }));
    is_never_negative = (is_conservative && !is_second_order) || is_average;
    gives_sources_away =
        has_word(name, "d2s") || has_word(name, "dtos") || has_word(name, "destination to source");
  }
  bool is_conservative = false;
  bool is_second_order = false;     // weights depend on gradients, too
  bool is_of_points = false;        // weights are between places, not shares of areas
  bool gives_sources_away = false;  // each source goes to one target, whose value is the sum of
                                    // what it receives
  bool is_never_negative = false;
};

}  // namespace rondel::interpolation
