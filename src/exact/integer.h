// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The last rung: integers of any size. A finite double is an integer times a power of
// two, so points scaled by a common power of two are integer vectors.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "exact/big_integer.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::exact {

using IntegerVector = Vector3<Integer>;

inline Sign sign_of(const Integer& value) { return static_cast<Sign>(value.sign()); }

inline bool is_zero(const IntegerVector& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// The points minus `center`, all multiplied by the same power of two, exactly.
std::vector<IntegerVector> scaled_differences(std::initializer_list<Point> points,
                                              const Point& center);

// The points minus `center`, each multiplied by a power of two of its own, exactly: enough where only
// its ray counts.
std::vector<IntegerVector> scaled_rays(std::initializer_list<Point> points, const Point& center);

// The square root rounded down. Precondition: n >= 0.
Integer floor_sqrt(const Integer& n);

// The sign of the sum of coefficient[i] * sqrt(radicand[i]), radicands positive.
//
// The exact zero test: two roots belong to one class when the product of their
// radicands is a perfect square. Roots of different classes are linearly independent over the
// rationals (Besicovitch, J. London Math. Soc. 15, 1940), so the sum is zero
// if and only if the sum over each class is. If it is not zero, raising the
// precision finds the sign.
Sign sign_of_root_sum(std::span<const Integer> coefficients, std::span<const Integer> radicands);

}  // namespace rondel::exact
