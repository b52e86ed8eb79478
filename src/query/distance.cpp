// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "exact/angles.h"
#include "exact/unit_vector.h"

namespace rondel::query {
namespace {

using exact::DoubleDouble;
using exact::SplitPoint;
using std::numbers::pi;

SplitPoint antipode(const SplitPoint& u) {
  return {{-u.hi.x, -u.hi.y, -u.hi.z}, {-u.lo.x, -u.lo.y, -u.lo.z}};
}

// The angle whose versine, 1 - cos, is given.
double angle_of_versine(double versine) {
  return 2 * exact::argument(std::sqrt(versine / 2), std::sqrt(1 - versine / 2));
}

struct Ratio {
  double value;   // r = |site - o| / R
  double excess;  // r^2 - 1
};

// No result where r is beyond 1e100.
std::optional<Ratio> length_ratio(const Point& site, const Sphere& sphere) {
  int exponent = 0;
  double squared_radius = std::frexp(sphere.squared_radius, &exponent);
  if (exponent % 2 != 0) {
    squared_radius *= 2;
    --exponent;
  }
  const auto term = [&](double coordinate, double origin) {
    const DoubleDouble d = exact::two_diff(coordinate, origin);
    const DoubleDouble s = {std::ldexp(d.hi, -exponent / 2), std::ldexp(d.lo, -exponent / 2)};
    return s * s;
  };
  const DoubleDouble square = (term(site.x, sphere.center.x) + term(site.y, sphere.center.y)) +
                              term(site.z, sphere.center.z);
  if (!(square.hi < 1e200)) return std::nullopt;
  return Ratio{std::sqrt(square.hi / squared_radius),
               (square - DoubleDouble{squared_radius, 0}).hi / squared_radius};
}

// The versine of the angle between two rays.
double versine_between(const Point& p, const Point& q, const Point& center) {
  return exact::squared_chord(exact::unit_vector(p, center), exact::unit_vector(q, center)).hi / 2;
}

}  // namespace

double angle_between(const Point& p, const Point& q, const Point& center) {
  const SplitPoint u = exact::unit_vector(p, center);
  const SplitPoint v = exact::unit_vector(q, center);
  const double d2 = exact::squared_chord(u, v).hi;
  if (d2 <= 2) return angle_of_versine(d2 / 2);
  return pi - angle_of_versine(exact::squared_chord(antipode(u), v).hi / 2);
}

// With the versine v of the angle between the rays and the quotient r = |site - o| / R, the cosine
// is (1-v) r, and 1 - (1-v) r = (1-r) + v r, where 1 - r = -(r^2-1) / (1+r).
double laguerre_distance(const Point& p, const Point& site, const Sphere& sphere) {
  if (site == sphere.center) return pi / 2;
  const double versine_of_rays = versine_between(p, site, sphere.center);
  const auto ratio = length_ratio(site, sphere);
  if (!ratio) return versine_of_rays < 1 ? 0 : pi;
  const double versine = versine_of_rays * ratio->value - ratio->excess / (1 + ratio->value);
  return angle_of_versine(std::clamp(versine, 0.0, 2.0));
}

}  // namespace rondel::query
