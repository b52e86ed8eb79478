// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The exact projection of a point on the unit sphere, to twice double precision.
#pragma once

#include "rondel/types.h"

namespace rondel::exact {

// The unevaluated sum hi + lo.
struct SplitPoint {
  Point hi;
  Point lo;
};

// The unit vector u = (p - center) / |p - center|.
// 1. hi is within 0.51 ulp of u in each coordinate, so |hi - u| <= 2^-53.
// 2. |hi + lo - u| <= 2^-100.
// 3. The result does not depend on the platform.
// Precondition: finite coordinates, p != center.
SplitPoint unit_vector(const Point& p, const Point& center);

}  // namespace rondel::exact
