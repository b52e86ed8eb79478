// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The area between an arc of a great circle and a parallel, in longitude and the sine of latitude.
//
// in    the arc's width in radians of longitude, and k = (sin p + sin q) / (1 + cos(p - q)) for the
//       latitudes p and q of its ends
// out   areas in steradians
#pragma once

namespace rondel::overlay {

// Returns sin(x) / x - 1 for |x| up to pi / 2.
double sine_ratio_less_one(double x);

// Returns 2 atan(k tan(width / 2)) - k width for 0 <= width <= pi and |k| <= 1, with a small
// relative error.
double area_of_bulge(double width, double k);

// Returns the same value for a caller that knows `gap` = 1 - |k|. Next to a pole, where |k| is
// nearly 1, the result is exact up to rounding of the gap.
double area_of_bulge(double width, double k, double gap);

}  // namespace rondel::overlay
