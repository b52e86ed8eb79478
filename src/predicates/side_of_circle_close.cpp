// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// With lengths P = |p-o| and Q = |q-o| of two rays, the step E from p to q on
// the sphere of radius Q follows from the difference of the points as given,
// which is exact for close points:
//
//     E = Q (q/Q - p/P) = (q - p) - p t,   t = (q - p).(q + p) / (P (P + Q)),
//
// coordinates counted from o. So its error is relative to |q - p| and not to Q.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "predicates/scale.h"
#include "predicates/side_of_circle.h"

namespace rondel::predicates {
namespace {

// E with its length divided by 2^exponent, which is about |q - p|.
struct Step {
  Vector along;
  double length;          // |E|
  double relative_error;  // of E, against its length
  int exponent;
};

struct Ray {
  Vector v;
  double length;
};

using FourRays = std::array<Ray, 4>;  // b, c, d, p
using GivenPoints = std::array<Vector, 4>;

// Rays whose longest coordinates are between 1 and 4, and the points that they
// lead to, all from the center: multiplied by one power of two where lengths
// agree that far, by one for each ray where the center is 0. Empty where
// neither holds, and for lengths far out of the range of doubles.
std::optional<FourRays> comparable_rays(GivenPoints& points, const Point& center) {
  const Vector origin = to_vector(center);
  FourRays rays{};
  std::array<int, 4> exponents{};
  for (std::size_t i = 0; i < 4; ++i) {
    rays[i].v = points[i] - origin;
    exponents[i] = exponent_of(rays[i].v);
  }
  const auto [lowest, highest] = std::ranges::minmax(exponents);
  if (lowest < -max_exponent || highest > max_exponent) return std::nullopt;
  const bool are_similar = highest - lowest <= 1;
  if (!are_similar && center != Point{}) return std::nullopt;
  for (std::size_t i = 0; i < 4; ++i) {
    const double factor = power_of_two(-(are_similar ? lowest : exponents[i]));
    rays[i].v = factor * rays[i].v;
    points[i] = factor * points[i];
    rays[i].length = std::sqrt(dot(rays[i].v, rays[i].v));
  }
  return rays;
}

// Empty where points are too close for doubles to tell.
std::optional<Step> step_between(const Vector& difference, const Ray& p, const Ray& q) {
  constexpr int min_exponent = -900;
  const int exponent = exponent_of(difference);
  if (exponent < min_exponent) return std::nullopt;
  const Vector d = power_of_two(-exponent) * difference;
  const double t = dot(d, p.v + q.v) / (p.length * (p.length + q.length));
  const Vector e = d - t * p.v;
  const double length = std::sqrt(dot(e, e));
  return Step{e, length, close_step_bound * std::sqrt(dot(d, d)) / length, exponent};
}

// A row of the determinant: E_x, E_y and E times a vector that is no longer than `breadth`.
struct StepRow {
  Step step;
  Vector sum;
  double breadth;
};

using Coordinates = std::array<double, 3>;

Coordinates coordinates(const Vector& v) { return {v.x, v.y, v.z}; }

// Returns the sign of a determinant of rows, seen from p. The relative errors of the rows add up to
// `error`.
Sign sign_of_rows(const std::array<StepRow, 3>& rows, const Vector& p, double error) {
  const Coordinates along = coordinates(p);
  const auto longer = [&](std::size_t i, std::size_t j) {
    return std::abs(along[i]) < std::abs(along[j]) ? j : i;
  };
  const std::size_t last = longer(longer(0, 1), 2);
  const std::size_t x = (last + 1) % 3;
  const std::size_t y = (last + 2) % 3;
  double value = 0;
  double breadths = 0;
  double lengths = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const StepRow& row = rows[i];
    const Coordinates next = coordinates(rows[(i + 1) % 3].step.along);
    const Coordinates after = coordinates(rows[(i + 2) % 3].step.along);
    value += dot(row.step.along, row.sum) * (next[x] * after[y] - next[y] * after[x]);
    breadths += row.breadth;
    lengths *= row.step.length;
  }
  const double bound = 2.5 * error + 20 * unit_roundoff;
  if (!(std::abs(value) > bound * (lengths * breadths))) return Sign::zero;
  return (value > 0) == (along[last] > 0) ? Sign::positive : Sign::negative;
}

}  // namespace

Sign side_of_circle_close(const Quad& q, const Point& center) {
  GivenPoints points = {to_vector(q[0]), to_vector(q[1]), to_vector(q[2]), to_vector(q[3])};
  const std::optional<FourRays> rays = comparable_rays(points, center);
  if (!rays) return Sign::zero;
  const auto order = order_for_best_origin(points);
  const auto difference = [&](std::size_t i, std::size_t j) {
    return points[order[j]] - points[order[i]];
  };
  const auto step = [&](std::size_t i, std::size_t j) {
    return step_between(difference(i, j), (*rays)[order[i]], (*rays)[order[j]]);
  };
  std::array<StepRow, 3> rows{};
  double error = 0;
  int highest = -1023;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = step(3, i);
    if (!e) return Sign::zero;
    rows[i].step = *e;
    error += e->relative_error;
    highest = std::max(highest, e->exponent);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Step& e = rows[i].step;
    const double to_unit =
        power_of_two(std::max(e.exponent - highest, -max_exponent)) / (*rays)[order[i]].length;
    rows[i].sum = to_unit * e.along;
    rows[i].breadth = to_unit * e.length;
  }
  // Two pairs: where c is far closer to b than to p, the row of b is taken from that of c.
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    constexpr int far_closer = 4;
    const int exponent = exponent_of(difference(i, j)) + far_closer;
    if (exponent > std::min(rows[i].step.exponent, rows[j].step.exponent)) continue;
    const auto e = step(i, j);
    if (!e) return Sign::zero;
    rows[j] = {*e, rows[i].sum + rows[j].sum, rows[i].breadth + rows[j].breadth};
    error += e->relative_error;
    break;
  }
  constexpr double max_error = 1.0 / 16;
  return error < max_error ? sign_of_rows(rows, (*rays)[order[3]].v, error) : Sign::zero;
}

}  // namespace rondel::predicates
