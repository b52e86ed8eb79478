// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The area between an arc of a great circle and a parallel, in longitude and the sine of latitude.
#pragma once

namespace rondel::overlay {

// sin(x) / x - 1 for |x| up to pi / 2.
double sine_ratio_less_one(double x);

// 2 atan(k tan(width / 2)) - k width for 0 <= width <= pi and |k| <= 1.
double area_of_bulge(double width, double k);

// The same where 1 - |k| is `gap`, next to a pole to rounding of the gap.
double area_of_bulge(double width, double k, double gap);

}  // namespace rondel::overlay
