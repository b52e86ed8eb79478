// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact signs of determinants of steps between points, in integers of the machine: where the
// coordinates of the points are so alike in size that, axis by axis, they all are multiples of one
// power of two below 2^60 times that. Points of a mesh mostly are. Empty where they are not, or
// where the compiler has no integers of 128 bits.
#pragma once

#include <optional>

#include "rondel/types.h"

namespace rondel::exact {

// Returns the sign of det(a-o, b-o, c-o), or nothing if integers do not suffice.
std::optional<Sign> sign_of_volume_in_integers(const Point& o, const Point& a, const Point& b,
                                               const Point& c);

}  // namespace rondel::exact
