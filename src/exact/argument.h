// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The argument of a complex number, the same bits on every platform: that of C libraries differs
// between them, and between processors with and without fused multiply-adds.
#pragma once

#include "rondel/export.h"

namespace rondel::exact {

// The argument of x + iy, from -pi to pi, for finite x and y.
// 1. Within 2.5 ulp of the exact value, as long as that is no subnormal number: just below 1/16, where atan(1/8) and a
//    difference as large are summed; within 1.75 ulp elsewhere.
// 2. Odd in y. With y = 0 it is y if x is not negative (0 of either sign is not), else pi with y's sign.
// Uses only operations that IEEE 754 rounds correctly.
RONDEL_API double argument(double y, double x);

}  // namespace rondel::exact
