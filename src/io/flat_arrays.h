// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks of arrays that callers bring, before they are written.
//
// in    points
// out   whether they can be what they are said to be
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "rondel/error.h"
#include "rondel/types.h"

namespace rondel::io {

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
