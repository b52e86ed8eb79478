// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks of arrays that callers bring, before they are written.
//
// in    offsets of compressed rows, and points
// out   whether they can be what they are said to be
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::io {

// True if the offsets begin with 0, end with `end` and do not decrease, and if there are num_rows +
// 1 of them.
inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t end) {
  return !offsets.empty() && offsets.front() == 0 && offsets.back() == end &&
         std::ranges::is_sorted(offsets);
}

inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t num_rows,
                        std::size_t end) {
  return offsets.size() == num_rows + 1 && are_offsets(offsets, end);
}

// True if the points have length 1 up to 1e-6 in the square.
inline bool are_unit_vectors(std::span<const Point> points) {
  return std::ranges::all_of(points, [](const Point& p) {
    return std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) < 1e-6;
  });
}

// Throws InvalidInput that names the arrays, unless `is_right`.
inline void require_fit(bool is_right, const std::string& what) {
  if (!is_right) throw InvalidInput("the arrays of the " + what + " do not fit together");
}

}  // namespace rondel::io
