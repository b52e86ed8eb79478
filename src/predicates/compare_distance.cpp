// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/compare_distance.h"

#include "exact/expansion.h"
#include "exact/integer.h"
#include "predicates/squared_chord.h"

namespace rondel::predicates {
namespace {

using exact::DoubleDouble;
using exact::Expansion;
using exact::expansion;
using exact::Integer;
using exact::two_diff;
using exact::two_product;

Expansion<6> dot_product(const Point& a, const Point& b) {
  return (expansion(two_product(a.x, b.x)) + expansion(two_product(a.y, b.y))) +
         expansion(two_product(a.z, b.z));
}

Sign angle_by_double_double(const Point& a, const Point& b, const Point& p, const Point& center) {
  const exact::SplitPoint u = exact::unit_vector(p, center);
  const DoubleDouble a2 = squared_chord(u, exact::unit_vector(a, center));
  const DoubleDouble b2 = squared_chord(u, exact::unit_vector(b, center));
  const double value = (b2 - a2).hi;
  constexpr double bound = angle_double_double_bound * angle_double_double_bound;
  return unless_unsure(value, value * value > bound * std::max(a2.hi, b2.hi));
}

// The sign of pa sqrt(b2) - pb sqrt(a2).
Sign sign_of_two_roots(const Integer& pa, const Integer& b2, const Integer& pb, const Integer& a2) {
  const Sign sign = exact::sign_of(pa);
  const Sign other = exact::sign_of(pb);
  if (sign != other) return sign > other ? Sign::positive : Sign::negative;
  return sign * exact::sign_of(Integer(pa * pa * b2 - pb * pb * a2));
}

Sign angle_exact(const Point& a, const Point& b, const Point& p, const Point& center) {
  if (center == Point{} && is_safe_for_expansions({a, b, p}) &&
      sign_of(dot_product(a, a) - dot_product(b, b)) == Sign::zero) {
    return sign_of(dot_product(p, a) - dot_product(p, b));
  }
  const auto v = exact::scaled_rays({a, b, p}, center);
  return sign_of_two_roots(dot(v[2], v[0]), dot(v[1], v[1]), dot(v[2], v[1]), dot(v[0], v[0]));
}

Sign power_exact(const Point& a, const Point& b, const Point& p, const Point& center) {
  if (is_safe_for_expansions({a, b, p, center})) {
    const auto term = [](double from, double to, double end, double origin) {
      return expansion(two_diff(to, from)) * expansion(two_diff(end, origin));
    };
    return sign_of((term(b.x, a.x, p.x, center.x) + term(b.y, a.y, p.y, center.y)) +
                   term(b.z, a.z, p.z, center.z));
  }
  const auto ray = exact::scaled_rays({p}, center).front();
  const auto v = exact::scaled_differences({a}, b).front();
  return exact::sign_of(dot(ray, v));
}

}  // namespace

Decision compare_angle_ladder(const Point& a, const Point& b, const Point& p, const Point& center) {
  const Sign sign = angle_by_double_double(a, b, p, center);
  if (sign != Sign::zero) return {sign, Rung::double_double};
  return {angle_exact(a, b, p, center), Rung::exact};
}

Decision compare_power_ladder(const Point& a, const Point& b, const Point& p, const Point& center) {
  return {power_exact(a, b, p, center), Rung::exact};
}

}  // namespace rondel::predicates
