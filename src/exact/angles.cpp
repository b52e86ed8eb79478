// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "exact/angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "exact/eft.h"

namespace rondel::exact {
namespace {

// The argument: with q the larger and p the smaller of |x| and |y|, and c = k/8 the eighth next to
// p/q,
//
//     atan(p/q) = atan(c) + atan(u),   u = (p - c q) / (q + c p),   |u| <= 1/16,
//
// and the octant tells what is added to or taken from atan(p/q).

// atan(k/8) as a sum of two doubles; a test would notice if one were off.
constexpr std::array<DoubleDouble, 9> arctangents = {{
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};

// u - atan(u), by its series up to u^13; what follows is below 2^-59 u.
double excess_over_arctangent(double u) {
  const double s = u * u;
  return u * s *
         (1.0 / 3 -
          s * (1.0 / 5 - s * (1.0 / 7 - s * (1.0 / 9 - s * (1.0 / 11 - s * (1.0 / 13))))));
}

// Returns a factor for both coordinates, which does not change the argument. It keeps sums of large
// numbers from overflow, and products of small numbers from losing digits.
double scale_for(double largest) {
  if (largest > 0x1p1000) return 0x1p-100;
  return largest < 0x1p-900 ? 0x1p120 : 1;
}

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

// Replaces degrees nearer to zero than any rounding by zero: programs that read the numbers
// multiply them, and products of tiny numbers underflow. Adding zero turns -0 into 0.
double without_tiny(double degrees) {
  constexpr double tiny = 0x1p-64;
  return std::abs(degrees) < tiny ? 0 : degrees + 0.0;
}

}  // namespace

double argument(double y, double x) {
  const double scale = scale_for(std::max(std::abs(x), std::abs(y)));
  const double width = scale * std::abs(x);
  const double height = scale * std::abs(y);
  const bool is_steep = height > width;
  const double p = is_steep ? width : height;
  const double q = is_steep ? height : width;
  if (q == 0) return y;

  const double ratio = p / q;
  const std::size_t k = static_cast<std::size_t>(16 * ratio + 1) / 2;  // 8 ratio, rounded
  const double c = 0.125 * static_cast<double>(k);
  const double u = k == 0 ? ratio : (p - c * q) / (q + c * p);
  const DoubleDouble& base = arctangents[k];
  const double rest = base.lo + (u - excess_over_arctangent(u));  // atan(p/q) less base.hi

  // turn +- atan(p/q), where turn is 0, pi/2 or pi.
  const bool is_left = x < 0;
  const DoubleDouble quarter = {2 * arctangents[8].hi, 2 * arctangents[8].lo};
  const double quarters = is_steep ? 1 : (is_left ? 2 : 0);
  const double sign = is_steep == is_left ? 1 : -1;
  const DoubleDouble head = two_sum(quarters * quarter.hi, sign * base.hi);
  const double result = head.hi + (head.lo + (quarters * quarter.lo + sign * rest));
  return std::copysign(result, y);
}

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

LonLat lonlat_of(const Point& p, bool east) {
  double lon = argument(p.y, p.x) * degrees_per_radian;
  if (p.y == 0) lon = p.x > 0 ? 0 : (east ? 180 : -180);
  const double lat = argument(p.z, distance_from_axis(p)) * degrees_per_radian;
  return {without_tiny(std::clamp(lon, -180.0, 180.0)), without_tiny(std::clamp(lat, -90.0, 90.0))};
}

}  // namespace rondel::exact
