// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tells whether a grid of places goes around.
//
// in    places row by row; unknown ones are (0, 0, 0)
// out   true or false
// index places: row * columns + column
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// True if the last place of each row whose two ends are known is beside the first one: at most 1.5
// times as far from it as the farthest neighbors in this row are from each other.
inline bool has_seam(std::span<const Point> places, std::size_t rows, std::size_t columns) {
  constexpr double most_steps = 1.5;
  const auto is_known = [](const Point& p) { return p != Point{0, 0, 0}; };
  const auto squared = [](const Point& a, const Point& b) { return dot(a - b, a - b); };
  bool is_told = false;
  for (std::size_t j = 0; columns > 2 && j < rows; ++j) {
    const std::span<const Point> row = places.subspan(j * columns, columns);
    if (!is_known(row.front()) || !is_known(row.back())) continue;
    double longest = 0;
    for (std::size_t i = 1; i < columns; ++i) {
      if (!is_known(row[i - 1]) || !is_known(row[i])) continue;
      longest = std::max(longest, squared(row[i - 1], row[i]));
    }
    if (squared(row.front(), row.back()) > most_steps * most_steps * longest) return false;
    is_told = true;
  }
  return is_told;
}

}  // namespace rondel::interpolation
