// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/degrees.h"

#include <cmath>

#include "exact/eft.h"

namespace rondel::exact {
namespace {

// Taylor sums for |t| <= pi/4, t = hi + lo; the first neglected term is below 2^-58 of the result.
double sine(DoubleDouble t) {
  const double s = t.hi * t.hi;
  const double p =
      s * (-1.0 / 6 +
           s * (1.0 / 120 +
                s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800 +
                                                            s * (1.0 / 6227020800.0 +
                                                                 s * (-1.0 / 1307674368000.0 +
                                                                      s / 355687428096000.0)))))));
  return t.hi + (t.hi * p + t.lo * (1 - 0.5 * s));
}

double cosine(DoubleDouble t) {
  const double s = t.hi * t.hi;
  const double p =
      s * s *
      (1.0 / 24 +
       s * (-1.0 / 720 +
            s * (1.0 / 40320 +
                 s * (-1.0 / 3628800 +
                      s * (1.0 / 479001600 + s * (-1.0 / 87178291200.0 + s / 20922789888000.0))))));
  const double half = 0.5 * s;
  const double head = 1 - half;
  return head + (((1 - head) - half) + (p - t.hi * t.lo));
}

}  // namespace

SineCosine sine_cosine_of_degrees(double degrees) {
  int quadrant = 0;
  const double rest = std::remquo(degrees, 90.0, &quadrant);  // exact, within [-45, 45]
  constexpr DoubleDouble radians_per_degree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
  DoubleDouble t = two_product(rest, radians_per_degree.hi);
  t.lo += rest * radians_per_degree.lo;
  const double s = sine(t);
  const double c = cosine(t);
  const int q = quadrant & 3;
  const double rotated_sine = (q & 1) != 0 ? c : s;
  const double rotated_cosine = (q & 1) != 0 ? s : c;
  // Adding 0 turns -0 into 0.
  return {(q >= 2 ? -rotated_sine : rotated_sine) + 0.0,
          (q == 1 || q == 2 ? -rotated_cosine : rotated_cosine) + 0.0};
}

}  // namespace rondel::exact
