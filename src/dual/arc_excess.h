// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What an arc adds to the moment of a spherical polygon beyond its chord.
#pragma once

#include "exact/angles.h"

namespace rondel::dual {

// t / sin(t) - 1 of an arc with this sine and cosine, t < pi.
inline double arc_excess(double sine, double cosine) {
  constexpr double series_limit = 0x1p-6;
  if (sine > series_limit || cosine < 0) {
    return sine == 0 ? 0 : exact::argument(sine, cosine) / sine - 1;
  }
  // asin(s)/s - 1; the first omitted term is below 2^-6^10 / 28.
  const double x = sine * sine;
  return x * (1.0 / 6 + x * (3.0 / 40 + x * (15.0 / 336 + x * (105.0 / 3456))));
}

}  // namespace rondel::dual
