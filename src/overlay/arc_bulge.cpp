// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/arc_bulge.h"

#include <cmath>
#include <numbers>

#include "exact/angles.h"

namespace rondel::overlay {
namespace {

// Returns tan(h) for h up to 1/8, by its series.
double small_tangent(double h) {
  const double u = h * h;
  return h * (1 + u * (1.0 / 3 +
                       u * (2.0 / 15 +
                            u * (17.0 / 315 +
                                 u * (62.0 / 2835 +
                                      u * (1382.0 / 155925 + u * (21844.0 / 6081075 +
                                                                  u * (929569.0 / 638512875))))))));
}

// Returns atan(t) / t - 1 for u = t^2 up to 1/63, by its series.
double small_arc_tangent(double u) {
  return -u * (1.0 / 3 -
               u * (1.0 / 5 -
                    u * (1.0 / 7 -
                         u * (1.0 / 9 -
                              u * (1.0 / 11 - u * (1.0 / 13 - u * (1.0 / 15 - u * (1.0 / 17))))))));
}

// Returns area_of_bulge() for k = 1 - gap. With t = tan(width / 2), atan(t) - atan(k t) = atan(gap
// t / (1 + k t^2)); numerator and denominator are multiplied by cos^2 here.
double bulge_at_pole(double width, double k, double gap) {
  const exact::SineCosine half = exact::sine_cosine_of_degrees(width * (90 / std::numbers::pi));
  return gap * width - 2 * exact::argument(gap * half.sine * half.cosine,
                                           half.cosine * half.cosine + k * half.sine * half.sine);
}

}  // namespace

double sine_ratio_less_one(double x) {
  const double u = x * x;
  constexpr int last_term = 23;  // (pi / 2)^22 / 23! < 2^-60
  double sum = 0;
  for (int n = last_term; n > 1; n -= 2) sum = -u / (n * (n - 1)) * (1 + sum);
  return sum;
}

double area_of_bulge(double width, double k) {
  constexpr double small = 0.25;
  if (width <= small) {
    const double t = small_tangent(width / 2);
    const double u = t * t;
    return 2 * k * t * (small_arc_tangent(k * k * u) - small_arc_tangent(u));
  }
  const exact::SineCosine half = exact::sine_cosine_of_degrees(width * (90 / std::numbers::pi));
  return 2 * exact::argument(k * half.sine, half.cosine) - k * width;
}

double area_of_bulge(double width, double k, double gap) {
  constexpr double near_pole = 0x1p-10;
  if (gap >= near_pole) return area_of_bulge(width, k);
  return k > 0 ? bulge_at_pole(width, k, gap) : -bulge_at_pole(width, -k, gap);
}

}  // namespace rondel::overlay
