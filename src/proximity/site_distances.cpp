// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proximity/site_distances.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>

#include "exact/angles.h"
#include "exact/exact_sign.h"
#include "exact/unit_vector.h"
#include "predicates/bounds.h"
#include "system/parallel.h"

namespace rondel::proximity {
namespace {

using exact::Ball;
using exact::DoubleDouble;
using exact::SplitPoint;

// Returns the sign of a value that is off by at most `bound` times the longer of two lengths, whose
// squares are given; zero where this error leaves the sign open.
Sign sign_beyond(double value, double bound, double square, double other) {
  if (!(value * value > bound * bound * std::max(square, other))) return Sign::zero;
  return value > 0 ? Sign::positive : Sign::negative;
}

// Returns the sign of p sqrt(s) - q sqrt(t), or nothing if the intervals of the four numbers leave
// it open.
template <std::size_t N>
std::optional<Sign> sign_of_roots(const Ball<N>& p, const Ball<N>& s, const Ball<N>& q,
                                  const Ball<N>& t) {
  const std::optional<Sign> sign = p.sign();
  const std::optional<Sign> other = q.sign();
  if (!sign || !other) return std::nullopt;
  if (*sign != *other) return *sign > *other ? Sign::positive : Sign::negative;
  if ((s - t).sign() == Sign::zero) return (p - q).sign();
  const std::optional<Sign> size = (p * p * s - q * q * t).sign();
  if (!size) return std::nullopt;
  return *sign == Sign::negative && *size != Sign::zero
             ? (*size == Sign::positive ? Sign::negative : Sign::positive)
             : (*sign == Sign::zero ? Sign::zero : *size);
}

// The formulas have degree 12 in differences of points. Their exact values have at most 12 * 2101 +
// 64 bits, which fit into the 400 words of 64 bits of the last rung.
template <class Formula>
Sign sign_of_degree_12(const Formula& formula) {
  const std::optional<Sign> sign = exact::first_known_sign<6, 16, 400>(formula);
  assert(sign);
  return *sign;
}

// Returns the sign of cos(cd) - cos(ab) times positive lengths, (c.d) |a||b| - (a.b) |c||d|. It is
// the sign of |ab| - |cd|, since a larger angle has a smaller cosine.
Sign compare_exactly(const Point& a, const Point& b, const Point& c, const Point& d,
                     const Point& center) {
  return sign_of_degree_12([&](const auto& step) {
    const auto va = step(center, a);
    const auto vb = step(center, b);
    const auto vc = step(center, c);
    const auto vd = step(center, d);
    return sign_of_roots(dot(vc, vd), dot(va, va) * dot(vb, vb), dot(va, vb),
                         dot(vc, vc) * dot(vd, vd));
  });
}

// Returns the sign of (u_c - u_a).(u_b - u_c) for unit vectors u, times positive lengths. With A =
// a.a and so on this is
//
//     R - L,   R = (c.b) sqrt(A) - (a.b) sqrt(C),   L = sqrt(B) (sqrt(A C) - c.a) >= 0
//
// so it is negative where R is. Otherwise it has the sign of R^2 - L^2 = X + 2 Y sqrt(A C) with
//
//     X = (c.b)^2 A + (a.b)^2 C - A B C - B (c.a)^2,   Y = B (c.a) - (c.b)(a.b)
Sign cap_sign_exactly(const Point& a, const Point& b, const Point& c, const Point& center) {
  return sign_of_degree_12([&](const auto& step) -> std::optional<Sign> {
    const auto va = step(center, a);
    const auto vb = step(center, b);
    const auto vc = step(center, c);
    const auto ab = dot(va, vb);
    const auto ca = dot(vc, va);
    const auto cb = dot(vc, vb);
    const auto aa = dot(va, va);
    const auto bb = dot(vb, vb);
    const auto cc = dot(vc, vc);
    const std::optional<Sign> r = sign_of_roots(cb, aa, ab, cc);
    if (!r) return std::nullopt;
    if (*r == Sign::negative) return r;
    const auto x = cb * cb * aa + ab * ab * cc - aa * bb * cc - bb * ca * ca;
    const auto y = (cb * ab - bb * ca).times_power_of_two(1);
    using Number = std::remove_cvref_t<decltype(x)>;
    return sign_of_roots(x, Number(1.0), y, aa * cc);
  });
}

}  // namespace

SiteDistances::SiteDistances(const Triangulation& triangulation, const Execution& execution)
    : sites_(triangulation.sites()),
      center_(triangulation.sphere().center),
      units_(triangulation.num_sites()) {
  constexpr std::size_t grain = 4096;
  std::vector<Index> all(units_.size());
  std::iota(all.begin(), all.end(), 0U);
  const std::span<const Point> points = sites_.points();
  system::parallel_for(execution.threads, all.size(), grain,
                       [&](std::size_t begin, std::size_t end) {
                         exact::unit_vectors(points, std::span(all).subspan(begin, end - begin),
                                             center_, units_.data() + begin);
                       });
}

DoubleDouble SiteDistances::squared(Index a, Index b) const {
  return exact::squared_chord(units_[a], units_[b]);
}

double SiteDistances::angle(Index a, Index b) const {
  const auto angle_of = [](double square) {
    return 2 * exact::argument(std::sqrt(square / 4), std::sqrt(1 - square / 4));
  };
  const double square = squared(a, b).hi;
  if (square <= 2) return angle_of(square);
  const auto& [hi, lo] = units_[b];
  const SplitPoint antipode{{-hi.x, -hi.y, -hi.z}, {-lo.x, -lo.y, -lo.z}};
  return std::numbers::pi - angle_of(exact::squared_chord(units_[a], antipode).hi);
}

Sign SiteDistances::compare(Index a, Index b, DoubleDouble ab, Index c, Index d,
                            DoubleDouble cd) const {
  const Sign sign = sign_beyond((ab - cd).hi, predicates::angle_double_double_bound, ab.hi, cd.hi);
  if (sign != Sign::zero) return sign;
  if (std::minmax(a, b) == std::minmax(c, d)) return Sign::zero;
  return compare_exactly(sites_[a], sites_[b], sites_[c], sites_[d], center_);
}

Sign SiteDistances::compare(Index a, Index b, Index c, Index d) const {
  const auto square = [&](Index i, Index j) {
    const Point& p = units_[i].hi;
    const Point& q = units_[j].hi;
    const double x = p.x - q.x;
    const double y = p.y - q.y;
    const double z = p.z - q.z;
    return x * x + y * y + z * z;
  };
  const double ab = square(a, b);
  const double cd = square(c, d);
  const Sign sign = sign_beyond(ab - cd, predicates::angle_bound, ab, cd);
  return sign != Sign::zero ? sign : compare(a, b, squared(a, b), c, d, squared(c, d));
}

// The product (c-a).(c-b) of unit vectors that are off by e each is off by 2e (|c-a| + |c-b|) +
// 4e^2, and by 8u |c-a||c-b| of rounding, where lengths are at most 2. For doubles, e = u, this is
// below 32u times the longer length; for double_doubles, with e = 2^-100 and products off by 2^-99
// of their size, it is below 2^-95 times that length. A product beyond such a bound is at most the
// square of the longer length, which then is far longer than e, so that the error of the length
// itself does not matter.
bool SiteDistances::is_in_cap(Index a, Index b, Index c) const {
  const auto difference = [](const SplitPoint& p, const SplitPoint& q) {
    return exact::Vector3<DoubleDouble>{
        DoubleDouble{p.hi.x, p.lo.x} - DoubleDouble{q.hi.x, q.lo.x},
        DoubleDouble{p.hi.y, p.lo.y} - DoubleDouble{q.hi.y, q.lo.y},
        DoubleDouble{p.hi.z, p.lo.z} - DoubleDouble{q.hi.z, q.lo.z}};
  };
  const Point& ua = units_[a].hi;
  const Point& ub = units_[b].hi;
  const Point& uc = units_[c].hi;
  const exact::Vector3<double> ca = {uc.x - ua.x, uc.y - ua.y, uc.z - ua.z};
  const exact::Vector3<double> cb = {uc.x - ub.x, uc.y - ub.y, uc.z - ub.z};
  constexpr double bound = 32 * 0x1p-53;
  Sign sign = sign_beyond(dot(ca, cb), bound, dot(ca, ca), dot(cb, cb));
  if (sign != Sign::zero) return sign == Sign::negative;
  const auto wide_ca = difference(units_[c], units_[a]);
  const auto wide_cb = difference(units_[c], units_[b]);
  sign = sign_beyond(dot(wide_ca, wide_cb).hi, predicates::angle_double_double_bound,
                     dot(wide_ca, wide_ca).hi, dot(wide_cb, wide_cb).hi);
  if (sign != Sign::zero) return sign == Sign::negative;
  return cap_sign_exactly(sites_[a], sites_[b], sites_[c], center_) != Sign::negative;
}

}  // namespace rondel::proximity
