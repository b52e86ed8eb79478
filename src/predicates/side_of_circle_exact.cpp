// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "exact/exact_sign.h"
#include "exact/integer.h"
#include "exact/integer_signs.h"
#include "predicates/side_of_circle.h"

namespace rondel::predicates {
namespace {

using exact::Ball;
using exact::BallStep;
using exact::BallVector;

template <std::size_t N>
using FourBalls = std::array<BallVector<N>, 4>;

template <std::size_t N>
FourBalls<N> rays_to(const Quad& points, const Point& center, const BallStep<N>& step) {
  return {step(center, points[0]), step(center, points[1]), step(center, points[2]),
          step(center, points[3])};
}

// The determinant of the four unit vectors with a last column of ones, times the product of the
// lengths, is the sum of four terms a_i sqrt(alpha_i): alpha_i the squared length of
// ray i, a_i a determinant of the other three. Terms of equal alpha are added exactly. When the
// sums agree in sign, or all are zero, that is the answer: so it is for sites on one great circle,
// on one sphere, and for mirrored sites. Otherwise nothing is returned.
template <std::size_t N>
std::optional<Sign> sign_by_equal_lengths(const FourBalls<N>& rays) {
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
using BallCoordinates = std::array<Ball<N>, 3>;

template <std::size_t N>
std::optional<BallCoordinates<N>> unit_vector_along(const BallVector<N>& ray) {
  const auto inverse = exact::inverse_square_root(dot(ray, ray));
  if (!inverse) return std::nullopt;
  return BallCoordinates<N>{ray.x * *inverse, ray.y * *inverse, ray.z * *inverse};
}

// The axis along which both unit vectors reach 1/2 on the same side, which close ones have; or 3.
template <std::size_t N>
std::size_t common_axis(const BallCoordinates<N>& v, const BallCoordinates<N>& w) {
  std::size_t axis = 0;
  while (axis < 3 && (v[axis].size_of_midpoint() < 0 || w[axis].size_of_midpoint() < 0 ||
                      v[axis].sign() != w[axis].sign()))
    ++axis;
  return axis;
}

// About the distance of two unit vectors.
template <std::size_t N>
exact::Magnitude distance_between(const BallCoordinates<N>& v, const BallCoordinates<N>& w) {
  const std::size_t axis = common_axis(v, w);
  if (axis == 3) return 1;
  return std::max((w[(axis + 1) % 3] - v[(axis + 1) % 3]).size(),
                  (w[(axis + 2) % 3] - v[(axis + 2) % 3]).size());
}

// The step from v to w times a scale, each coordinate with a small relative error. Along the common
// axis z, where the difference would cancel, it follows from the others: as |v| = |w|,
//
//     (w_z - v_z) (w_z + v_z) = -(w_x - v_x) (w_x + v_x) - (w_y - v_y) (w_y + v_y).
template <std::size_t N>
struct Edge {
  BallCoordinates<N> step;
  Ball<N> scale = Ball<N>(1.0);

  Edge(const BallCoordinates<N>& v, const BallCoordinates<N>& w) {
    for (std::size_t i = 0; i < 3; ++i) step[i] = w[i] - v[i];
    const std::size_t z = common_axis(v, w);
    if (z == 3) return;
    const std::size_t x = (z + 1) % 3;
    const std::size_t y = (z + 2) % 3;
    scale = w[z] + v[z];
    step[z] = -(step[x] * (w[x] + v[x]) + step[y] * (w[y] + v[y]));
    step[x] = step[x] * scale;
    step[y] = step[y] * scale;
  }
};

template <std::size_t N>
Ball<N> dot_product(const BallCoordinates<N>& v, const BallCoordinates<N>& w) {
  return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
}

// For each of b, c and d the nearer end of its edge in the tree of shortest edges that grows from p.
template <std::size_t N>
std::array<std::size_t, 3> shortest_tree(const std::array<BallCoordinates<N>, 4>& units) {
  std::array<std::size_t, 3> parent = {3, 3, 3};
  std::array<exact::Magnitude, 3> distance{};
  std::array<bool, 3> is_done{};
  for (std::size_t i = 0; i < 3; ++i) distance[i] = distance_between<N>(units[3], units[i]);
  for (std::size_t count = 0; count < 2; ++count) {
    std::size_t nearest = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_done[i] && (nearest == 3 || distance[i] < distance[nearest])) nearest = i;
    }
    is_done[nearest] = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_done[i]) continue;
      const exact::Magnitude step = distance_between<N>(units[nearest], units[i]);
      if (step >= distance[i]) continue;
      distance[i] = step;
      parent[i] = nearest;
    }
  }
  return parent;
}

// The determinant of side_of_circle_close.cpp with rows (B_x, B_y, |B|^2), B = b-p, of unit vectors.
// Where c is closer to b than to p, the row of b is taken away from that of c, which leaves
// (c-b)_x, (c-b)_y and |C|^2 - |B|^2 = (c-b).(C+B): no row is then larger than it must be.
template <std::size_t N>
std::optional<Sign> sign_by_edges(const FourBalls<N>& rays) {
  std::array<BallCoordinates<N>, 4> units;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto unit = unit_vector_along(rays[i]);
    if (!unit) return std::nullopt;
    units[i] = *unit;
  }
  const BallCoordinates<N>& p = units[3];
  std::size_t last = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (p[last].size() < p[i].size()) last = i;
  }
  const std::size_t x = (last + 1) % 3;
  const std::size_t y = (last + 2) % 3;
  std::optional<Sign> factor = p[last].sign();
  if (!factor) return std::nullopt;
  const std::array<std::size_t, 3> parent = shortest_tree<N>(units);
  std::array<BallVector<N>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge<N> edge(units[parent[i]], units[i]);
    if (parent[i] == 3) {
      rows[i] = {edge.scale * edge.step[x], edge.scale * edge.step[y],
                 dot_product<N>(edge.step, edge.step)};
      continue;
    }
    const std::optional<Sign> sign = edge.scale.sign();
    if (!sign) return std::nullopt;
    factor = *factor * *sign;
    BallCoordinates<N> sum;
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] = (units[i][k] - p[k]) + (units[parent[i]][k] - p[k]);
    }
    rows[i] = {edge.step[x], edge.step[y], dot_product<N>(edge.step, sum)};
  }
  const std::optional<Sign> sign = det(rows[0], rows[1], rows[2]).sign();
  if (!sign || *sign == Sign::zero) return std::nullopt;
  return *factor * *sign;
}

Sign sign_by_integers(const Quad& points, const Point& center) {
  const auto v = exact::scaled_rays({points[0], points[1], points[2], points[3]}, center);
  const std::array<exact::Integer, 4> coefficients = {
      -det(v[0], v[1], v[2]), det(v[3], v[1], v[2]), -det(v[3], v[0], v[2]), det(v[3], v[0], v[1])};
  const std::array<exact::Integer, 4> radicands = {dot(v[3], v[3]), dot(v[0], v[0]),
                                                   dot(v[1], v[1]), dot(v[2], v[2])};
  return exact::sign_of_root_sum(coefficients, radicands);
}

}  // namespace

std::optional<Sign> side_of_circle_integers_exact(const Quad& q, const Point& center) {
  return exact::side_of_rays_in_integers(q, center);
}

Sign side_of_circle_exact(const Quad& q, const Point& center) {
  const auto by_edges = [&](const auto& step) { return sign_by_edges(rays_to(q, center, step)); };
  const auto by_equal_lengths = [&](const auto& step) {
    return sign_by_equal_lengths(rays_to(q, center, step));
  };
  std::optional<Sign> sign = exact::first_known_sign<4>(by_equal_lengths);
  if (!sign) sign = exact::first_known_sign<2>(by_edges);
  if (!sign) sign = exact::side_of_rays_in_integers(q, center);
  if (!sign) sign = exact::first_known_sign<6>(by_equal_lengths);
  if (!sign) sign = exact::first_known_sign<4, 8, 16>(by_edges);
  return sign ? *sign : sign_by_integers(q, center);
}

}  // namespace rondel::predicates
