// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/within_angle.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "exact/angles.h"
#include "exact/exact_sign.h"
#include "exact/unit_vector.h"

namespace rondel::predicates {
namespace {

using exact::Ball;

// The sign of x - c sqrt(y) for y > 0, if it is known. Twice the cosine is 2 - t or t - 2.
template <std::size_t N>
std::optional<Sign> compare_with_root(const Ball<N>& x, const Cosine& cosine, const Ball<N>& y) {
  const Ball<N> size_of_c = Ball<N>(2.0) - Ball<N>(cosine.t);
  const std::optional<Sign> sign = x.sign();
  const std::optional<Sign> size = size_of_c.sign();
  if (!sign || !size) return std::nullopt;
  const Sign left = *sign;
  const Sign right = cosine.is_positive ? *size : -*size;
  if (left != right) return left > right ? Sign::positive : Sign::negative;
  const std::optional<Sign> squares = (Ball<N>(4.0) * (x * x) - size_of_c * size_of_c * y).sign();
  if (!squares) return std::nullopt;
  return left * *squares;
}

}  // namespace

Cosine cosine_of(double angle) {
  constexpr double pi = std::numbers::pi;
  const bool is_positive = angle <= pi / 2;
  const double rest = is_positive ? angle : pi - angle;
  const double sine = exact::sine_cosine_of_degrees(rest * (90 / pi)).sine;
  return {is_positive, std::min(4 * (sine * sine), 2.0)};
}

Sign is_within_angle_double_double(const exact::SplitPoint& a, const exact::SplitPoint& p,
                                   const Cosine& cosine) {
  exact::SplitPoint u = p;
  if (!cosine.is_positive) {
    u = {{-u.hi.x, -u.hi.y, -u.hi.z}, {-u.lo.x, -u.lo.y, -u.lo.z}};
  }
  const exact::DoubleDouble d2 = squared_chord(u, a);
  const double excess = (d2 - exact::DoubleDouble{cosine.t, 0}).hi;
  constexpr double bound = angle_double_double_bound * angle_double_double_bound;
  const Sign sign = unless_unsure(excess, excess * excess > bound * std::max(d2.hi, cosine.t));
  return cosine.is_positive ? -sign : sign;
}

Sign is_within_angle_exact(const Point& a, const Point& p, const Cosine& cosine,
                           const Point& center) {
  return exact::sign_of_sextic([&](const auto& step) {
    const auto v = step(center, a);
    const auto w = step(center, p);
    return compare_with_root(dot(v, w), cosine, dot(v, v) * dot(w, w));
  });
}

Sign is_within_power_exact(const Point& a, const Point& p, const Cosine& cosine,
                           const Sphere& sphere) {
  return exact::sign_of_sextic([&]<std::size_t N>(const exact::BallStep<N>& step) {
    const auto v = step(sphere.center, a);
    const auto ray = step(sphere.center, p);
    return compare_with_root(dot(ray, v), cosine, Ball<N>(sphere.squared_radius) * dot(ray, ray));
  });
}

Sign is_within_power_filter(const Point& a, const Point& p, const Cosine& cosine,
                            const Sphere& sphere) {
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

}  // namespace rondel::predicates
