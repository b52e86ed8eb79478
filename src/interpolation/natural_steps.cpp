// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/natural_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "exact/exact_sign.h"

namespace rondel::interpolation {
namespace {

using exact::Ball;
using exact::BallVector;
using exact::DoubleDouble;

template <std::size_t N>
std::optional<BallVector<N>> unit(const Point& p, const Point& center) {
  const BallVector<N> ray = exact::BallStep<N>()(center, p);
  const auto inverse = exact::inverse_square_root(dot(ray, ray));
  if (!inverse) return std::nullopt;
  return BallVector<N>{ray.x * *inverse, ray.y * *inverse, ray.z * *inverse};
}

template <std::size_t N>
double to_double(const Ball<N>& a) {
  if (a.size_of_midpoint() == exact::nothing) return 0;
  const double size = std::ldexp(static_cast<double>(a.leading()), a.size_of_midpoint() - 64);
  return a.sign() == Sign::negative ? -size : size;
}

template <std::size_t N>
DoubleDouble to_wide(const Ball<N>& a) {
  const Ball<N> midpoint = a.midpoint();
  const double hi = to_double(midpoint);
  return {hi, to_double((midpoint - Ball<N>(hi)).midpoint())};
}

// The exponent of the largest coordinate.
template <std::size_t N>
int size_of(const BallVector<N>& v) {
  return std::max(
      {v.x.size_of_midpoint(), v.y.size_of_midpoint(), v.z.size_of_midpoint()});
}

// Whether N words were enough.
template <std::size_t N>
bool make_steps(const Point& from, std::span<const Point> sites, const Point& center,
                std::vector<WideVector>& steps, int& exponent) {
  constexpr int wanted_bits = 95;
  const auto u = unit<N>(from, center);
  if (!u) return false;
  std::vector<BallVector<N>> balls;
  exponent = exact::nothing;
  for (const Point& site : sites) {
    const auto x = unit<N>(site, center);
    if (!x) return false;
    balls.push_back(*x - *u);
    const BallVector<N>& d = balls.back();
    const int radius = std::max({d.x.radius(), d.y.radius(), d.z.radius()});
    if (size_of(d) < radius + wanted_bits) return false;
    exponent = std::max(exponent, size_of(d));
  }
  steps.clear();
  for (const BallVector<N>& d : balls) {
    steps.push_back({to_wide(d.x.times_power_of_two(-exponent)),
                     to_wide(d.y.times_power_of_two(-exponent)),
                     to_wide(d.z.times_power_of_two(-exponent))});
  }
  return true;
}

}  // namespace

// Rays of doubles are at least 2^-4200 apart.
double exact_wide_steps(const Point& from, std::span<const Point> sites, const Point& center,
                        std::vector<WideVector>& steps) {
  int exponent = 0;
  if (!make_steps<5>(from, sites, center, steps, exponent) &&
      !make_steps<36>(from, sites, center, steps, exponent)) {
    make_steps<104>(from, sites, center, steps, exponent);
  }
  return std::ldexp(1.0, exponent);
}

}  // namespace rondel::interpolation
