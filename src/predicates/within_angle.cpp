// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/within_angle.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "exact/degrees.h"
#include "exact/integer.h"
#include "predicates/squared_chord.h"

namespace rondel::predicates {
namespace {

using exact::Integer;

// integer * 2^exponent
struct Scaled {
  Integer integer;
  int exponent = 0;
};

Scaled scaled(double value) {
  constexpr int mantissa_bits = 53;
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), mantissa_bits);
  return {Integer(static_cast<std::int64_t>(mantissa)), exponent - mantissa_bits};
}

// 1 - t/2 for 0 <= t <= 2.
Scaled complement(double t) {
  if (t == 0) return {1, 0};
  Scaled half = scaled(t);
  --half.exponent;  // at most -52
  half.integer = (Integer(1) << -half.exponent) - half.integer;
  return half;
}

// The sign of a - b.
Sign compare(const Scaled& a, const Scaled& b) {
  const int shift = a.exponent - b.exponent;
  return shift >= 0 ? exact::sign_of(Integer((a.integer << shift) - b.integer))
                    : exact::sign_of(Integer(a.integer - (b.integer << -shift)));
}

// The sign of x - c sqrt(y): x = product * 2^exponent, y > 0.
Sign compare_with_root(const Integer& product, int exponent, const Cosine& cosine,
                       const Scaled& y) {
  Scaled c = complement(cosine.t);
  const Sign left = exact::sign_of(product);
  const Sign size = exact::sign_of(c.integer);
  const Sign right = cosine.is_positive ? size : -size;
  if (left != right) return left > right ? Sign::positive : Sign::negative;
  const Scaled x2 = {product * product, 2 * exponent};
  return left * compare(x2, {c.integer * c.integer * y.integer, 2 * c.exponent + y.exponent});
}

Sign angle_exact(const Point& a, const Point& p, const Cosine& cosine, const Point& center) {
  const auto v = exact::scaled_rays({a, p}, center);
  return compare_with_root(dot(v[0], v[1]), 0, cosine, {dot(v[0], v[0]) * dot(v[1], v[1]), 0});
}

Sign power_exact(const Point& a, const Point& p, const Cosine& cosine, const Sphere& sphere) {
  const auto ray = exact::scaled_rays({p}, sphere.center).front();
  // The last two give the scale: they are 1 apart.
  const auto v = exact::scaled_differences({a, {1, 0, 0}, {0, 0, 0}}, sphere.center);
  const Integer one = v[1].x - v[2].x;
  const int exponent = -static_cast<int>(msb(one));
  Scaled y = scaled(sphere.squared_radius);
  y.integer *= dot(ray, ray);
  return compare_with_root(dot(ray, v[0]), exponent, cosine, y);
}

Sign power_filter(const Point& a, const Point& p, const Cosine& cosine, const Sphere& sphere) {
  const Vector ray = to_vector(p) - to_vector(sphere.center);
  const Vector v = to_vector(a) - to_vector(sphere.center);
  const double ray2 = dot(ray, ray);
  const double limit = std::sqrt(ray2 * sphere.squared_radius) * (1 - cosine.t / 2);
  const double size = std::sqrt(ray2 * dot(v, v)) + std::abs(limit);
  const double value = dot(ray, v) - (cosine.is_positive ? limit : -limit);
  const bool is_safe =
      size > 0x1p-400 && ray2 > 0x1p-800 && ray2 * sphere.squared_radius > 0x1p-800;
  return unless_unsure(value, is_safe && std::abs(value) > within_power_bound * size);
}

}  // namespace

Cosine cosine_of(double angle) {
  constexpr double pi = std::numbers::pi;
  const bool is_positive = angle <= pi / 2;
  const double rest = is_positive ? angle : pi - angle;
  const double sine = exact::sine_cosine_of_degrees(rest * (90 / pi)).sine;
  return {is_positive, std::min(4 * (sine * sine), 2.0)};
}

Decision is_within_angle_ladder(const Point& a, const Point& p, const Cosine& cosine,
                                const Point& center) {
  exact::SplitPoint u = exact::unit_vector(p, center);
  if (!cosine.is_positive) {
    u = {{-u.hi.x, -u.hi.y, -u.hi.z}, {-u.lo.x, -u.lo.y, -u.lo.z}};
  }
  const exact::DoubleDouble d2 = squared_chord(u, exact::unit_vector(a, center));
  const double excess = (d2 - exact::DoubleDouble{cosine.t, 0}).hi;
  constexpr double bound = angle_double_double_bound * angle_double_double_bound;
  const Sign sign = unless_unsure(excess, excess * excess > bound * std::max(d2.hi, cosine.t));
  if (sign != Sign::zero) return {cosine.is_positive ? -sign : sign, Rung::double_double};
  return {angle_exact(a, p, cosine, center), Rung::exact};
}

Decision is_within_power_ladder(const Point& a, const Point& p, const Cosine& cosine,
                                const Sphere& sphere) {
  const Sign sign = power_filter(a, p, cosine, sphere);
  if (sign != Sign::zero) return {sign, Rung::filter};
  return {power_exact(a, p, cosine, sphere), Rung::exact};
}

}  // namespace rondel::predicates
