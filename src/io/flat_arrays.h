// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What arrays of callers have to be before they are written.
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

inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t end) {
  return !offsets.empty() && offsets.front() == 0 && offsets.back() == end &&
         std::ranges::is_sorted(offsets);
}

inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t num_rows,
                        std::size_t end) {
  return offsets.size() == num_rows + 1 && are_offsets(offsets, end);
}

inline bool are_unit_vectors(std::span<const Point> points) {
  return std::ranges::all_of(points, [](const Point& p) {
    return std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1) < 1e-6;
  });
}

inline void require_fit(bool is_right, const std::string& what) {
  if (!is_right) throw InvalidInput("the arrays of the " + what + " do not fit together");
}

}  // namespace rondel::io
