// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sine and cosine of degrees, the same bits on every platform.
#pragma once

#include "rondel/export.h"

namespace rondel::exact {

struct SineCosine {
  double sine;
  double cosine;
};

// 1. Within 1 ulp of the exact values (2 ulp for sines of angles below 1e-300, whose products lose digits).
// 2. Multiples of 90 degrees give exactly -1, 0 or 1; zeros are positive.
// 3. Odd (sine) and even (cosine) in the angle; unchanged when the angle grows by 360 degrees.
// Uses only operations that IEEE 754 rounds correctly, and an exact remainder.
RONDEL_API SineCosine sine_cosine_of_degrees(double degrees);

}  // namespace rondel::exact
