// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "exact/exact_sign.h"
#include "exact/integer.h"
#include "predicates/side_of_circle.h"

namespace rondel::predicates {
namespace {

using exact::Ball;
using exact::BallStep;
using exact::BallVector;

using FourPoints = std::array<Point, 4>;  // b, c, d, p

template <std::size_t N>
using FourRays = std::array<BallVector<N>, 4>;

template <std::size_t N>
FourRays<N> rays_to(const FourPoints& points, const Point& center, const BallStep<N>& step) {
  return {step(center, points[0]), step(center, points[1]), step(center, points[2]),
          step(center, points[3])};
}

// The determinant of the four unit vectors with a last column of ones, times the product of the
// lengths, is the sum of four terms a_i sqrt(alpha_i): alpha_i the squared length of
// ray i, a_i a determinant of the other three. Terms of equal alpha are added exactly. When the
// sums agree in sign, or all are zero, that is the answer: so it is for sites on one great circle,
// on one sphere, and for mirrored sites. Otherwise nothing is returned.
template <std::size_t N>
std::optional<Sign> sign_by_equal_lengths(const FourRays<N>& rays) {
  const auto& [b, c, d, p] = rays;
  const BallVector<N> cd = cross(c, d);
  const BallVector<N> pb = cross(p, b);
  const std::array<Ball<N>, 4> a = {dot(p, cd), -dot(b, cd), -dot(d, pb), dot(c, pb)};
  const std::array<const BallVector<N>*, 4> rays_of = {&b, &p, &c, &d};
  std::array<Ball<N>, 4> alpha;
  std::array<bool, 4> done{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::optional<Sign> sign = a[i].sign();
    if (!sign) return std::nullopt;
    done[i] = *sign == Sign::zero;
    if (!done[i]) alpha[i] = dot(*rays_of[i], *rays_of[i]);
  }
  Sign common = Sign::zero;
  for (std::size_t i = 0; i < 4; ++i) {
    if (done[i]) continue;
    Ball<N> sum = a[i];
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (done[j]) continue;
      const std::optional<Sign> difference = (alpha[i] - alpha[j]).sign();
      if (!difference) return std::nullopt;
      if (*difference != Sign::zero) continue;
      done[j] = true;
      sum = sum + a[j];
    }
    const std::optional<Sign> sign = sum.sign();
    if (!sign) return std::nullopt;
    if (*sign == Sign::zero) continue;
    if (common != Sign::zero && *sign != common) return std::nullopt;
    common = *sign;
  }
  return common;
}

template <std::size_t N>
BallVector<N> times_power_of_two(const BallVector<N>& v, int power) {
  return {v.x.times_power_of_two(power), v.y.times_power_of_two(power),
          v.z.times_power_of_two(power)};
}

// The formula of side_of_circle_close.cpp. The step E from p to q, times k = P (P + Q), is
// G = k (q - p) - p (q - p).(q + p), and its row (E_x, E_y, |E|^2 / Q) has the direction of
// (k Q G_x, k Q G_y, |G|^2).
template <std::size_t N>
std::optional<Sign> sign_by_steps(FourRays<N> rays) {
  std::array<Ball<N>, 4> lengths;
  std::array<int, 4> powers{};
  for (std::size_t i = 0; i < 4; ++i) {
    lengths[i] = dot(rays[i], rays[i]);
    powers[i] = -exact::floor_half(lengths[i].size());
  }
  // One power for all where lengths agree that far: what points have in common then cancels.
  const auto [lowest, highest] = std::ranges::minmax(powers);
  for (std::size_t i = 0; i < 4; ++i) {
    const int power = highest - lowest <= 1 ? lowest : powers[i];
    rays[i] = times_power_of_two(rays[i], power);
    const Ball<N> squared = lengths[i].times_power_of_two(2 * power);
    const auto inverse = exact::inverse_square_root(squared);
    if (!inverse) return std::nullopt;
    lengths[i] = squared * *inverse;
  }
  const BallVector<N>& p = rays[3];
  std::array<BallVector<N>, 3> rows;
  std::array<exact::Magnitude, 3> sizes = {p.x.size(), p.y.size(), p.z.size()};
  const std::size_t last =
      static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  for (std::size_t i = 0; i < 3; ++i) {
    const BallVector<N> d = rays[i] - p;
    const Ball<N> k = lengths[3] * (lengths[3] + lengths[i]);
    const Ball<N> s = dot(d, rays[i] + p);
    const BallVector<N> g = {k * d.x - s * p.x, k * d.y - s * p.y, k * d.z - s * p.z};
    const Ball<N> scale = k * lengths[i];
    const std::array<const Ball<N>*, 3> along = {&g.x, &g.y, &g.z};
    rows[i] = {scale * *along[(last + 1) % 3], scale * *along[(last + 2) % 3], dot(g, g)};
  }
  const std::optional<Sign> sign = det(rows[0], rows[1], rows[2]).sign();
  const std::array<const Ball<N>*, 3> along = {&p.x, &p.y, &p.z};
  const std::optional<Sign> side = along[last]->sign();
  if (!sign || !side || *sign == Sign::zero) return std::nullopt;
  return *sign * *side;
}

Sign sign_by_integers(const FourPoints& points, const Point& center) {
  const auto v = exact::scaled_rays({points[0], points[1], points[2], points[3]}, center);
  const std::array<exact::Integer, 4> coefficients = {
      -det(v[0], v[1], v[2]), det(v[3], v[1], v[2]), -det(v[3], v[0], v[2]), det(v[3], v[0], v[1])};
  const std::array<exact::Integer, 4> radicands = {dot(v[3], v[3]), dot(v[0], v[0]),
                                                   dot(v[1], v[1]), dot(v[2], v[2])};
  return exact::sign_of_root_sum(coefficients, radicands);
}

}  // namespace

Sign side_of_circle_exact(const Point& b, const Point& c, const Point& d, const Point& p,
                          const Point& center) {
  const FourPoints points = {b, c, d, p};
  const auto known = exact::first_known_sign<6>(
      [&](const auto& step) { return sign_by_equal_lengths(rays_to(points, center, step)); });
  if (known) return *known;
  const auto close = exact::first_known_sign<4, 8, 16>(
      [&](const auto& step) { return sign_by_steps(rays_to(points, center, step)); });
  return close ? *close : sign_by_integers(points, center);
}

}  // namespace rondel::predicates
