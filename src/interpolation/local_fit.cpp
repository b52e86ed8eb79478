// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/local_fit.h"

#include <algorithm>
#include <cmath>

namespace rondel::interpolation {
namespace {

// Degree and power of b of the terms a, b, a^2, ab, b^2, a^3 ...
constexpr std::array<std::size_t, LocalFit::max_terms> degrees = {1, 1, 2, 2, 2, 3, 3, 3, 3};
constexpr std::array<std::size_t, LocalFit::max_terms> powers_of_b = {0, 1, 0, 1, 2, 0, 1, 2, 3};

// The radius at which weights vanish, over the distance of the farthest neighbor.
constexpr double reach = 1.1;
// No neighbor weighs more than one at this part of the radius.
constexpr double least_radius = 1.0 / 16;

// Clouds thinner than this, and those whose thinness rounding may have made, are lines.
constexpr double least_thickness = 0x1p-40;
constexpr double least_remainder = 0x1p-30;

// The sum of c_t times term t.
double polynomial(const std::array<double, LocalFit::max_terms>& c, double a, double b) {
  const double linear = c[0] * a + c[1] * b;
  const double quadratic = c[2] * (a * a) + c[3] * (a * b) + c[4] * (b * b);
  const double cubic = (a * a) * (c[5] * a + c[6] * b) + (b * b) * (c[7] * a + c[8] * b);
  return (linear + quadratic) + cubic;
}

}  // namespace

bool LocalFit::set_chart(const Vec& x, std::span<const Vec> steps) {
  scale_ = 0;
  for (const Vec& step : steps) scale_ = std::max(scale_, largest_coordinate(step));
  if (!(scale_ >= 0x1p-1000)) return false;
  const auto farthest = std::ranges::max_element(
      steps, {}, [this](const Vec& step) { return dot(step / scale_, step / scale_); });
  // x.step = -|step|^2 / 2.
  first_axis_ = normalized(*farthest / scale_ + (dot(*farthest, *farthest / scale_) / 2) * x);
  second_axis_ = cross(x, first_axis_);
  points_.clear();
  double largest = 0;
  for (const Vec& step : steps) {
    const double stretch = 1 / ((1 - dot(step, step) / 4) * scale_);
    const double a = dot(first_axis_, step) * stretch;
    const double b = dot(second_axis_, step) * stretch;
    const double squared_radius = a * a + b * b;
    largest = std::max(largest, squared_radius);
    points_.push_back({a, b, squared_radius});
  }
  const double radius = reach * std::sqrt(largest);
  const double least = (least_radius * least_radius) * (radius * radius);
  for (ChartPoint& p : points_) {
    const double lacking = radius - std::sqrt(p.weight);
    p.weight = (lacking * lacking) / std::max(p.weight, least);
  }
  return true;
}

bool LocalFit::make_round() {
  double aa = 0;
  double ab = 0;
  double bb = 0;
  for (const auto& [a, b, weight] : points_) {
    aa += weight * (a * a);
    ab += weight * (a * b);
    bb += weight * (b * b);
  }
  shear_ = ab / aa;
  const double rest = bb - shear_ * ab;
  if (!(rest > least_thickness * least_thickness * aa && rest > least_remainder * bb)) return false;
  to_round_ = {1 / std::sqrt(aa), 1 / std::sqrt(rest)};
  for (ChartPoint& p : points_) {
    p.b = to_round_[1] * (p.b - shear_ * p.a);
    p.a *= to_round_[0];
  }
  return true;
}

void LocalFit::add_moments() {
  moments_ = {};
  for (const auto& [a, b, weight] : points_) {
    std::array<double, 7> power{weight * (a * a), weight * (a * b), weight * (b * b)};
    for (std::size_t q = 0; q < 3; ++q) moments_[0][q] += power[q];
    for (std::size_t s = 3; s <= 6; ++s) {
      power[s] = power[s - 1] * b;
      for (std::size_t q = 0; q < s; ++q) power[q] *= a;
      for (std::size_t q = 0; q <= s; ++q) moments_[s - 2][q] += power[q];
    }
  }
}

double LocalFit::entry(std::size_t i, std::size_t j) const {
  return moments_[degrees[i] + degrees[j] - 2][powers_of_b[i] + powers_of_b[j]];
}

// Up to the last degree at whose end no pivot is too small.
void LocalFit::factor(std::size_t most_terms) {
  for (std::size_t i = 0; i < most_terms; ++i) {
    Coefficients& row = lower_[i];
    double pivot = entry(i, i);
    const double least = least_pivot * pivot;
    for (std::size_t j = 0; j < i; ++j) {
      double rest = entry(i, j);
      for (std::size_t k = 0; k < j; ++k) rest -= row[k] * lower_[j][k];
      row[j] = rest;  // times the pivot of j, until the row is complete
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double scaled = row[j] / pivots_[j];
      pivot -= scaled * row[j];
      row[j] = scaled;
    }
    if (!(pivot > least)) {
      num_terms_ = i < terms_of_degree[1] ? terms_of_degree[0] : terms_of_degree[1];
      return;
    }
    pivots_[i] = pivot;
  }
  num_terms_ = most_terms;
}

LocalFit::Coefficients LocalFit::solved_for(std::size_t unit) const {
  Coefficients c{};
  c[unit] = 1;
  for (std::size_t i = unit + 1; i < num_terms_; ++i) {
    for (std::size_t k = unit; k < i; ++k) c[i] -= lower_[i][k] * c[k];
  }
  for (std::size_t i = 0; i < num_terms_; ++i) c[i] /= pivots_[i];
  for (std::size_t i = num_terms_; i-- > 0;) {
    for (std::size_t k = 0; k < i; ++k) c[k] -= lower_[i][k] * c[i];
  }
  return c;
}

bool LocalFit::find(const Vec& x, std::span<const Vec> steps, std::vector<Vec>& weights) {
  weights.clear();
  num_terms_ = 0;
  if (steps.size() < terms_of_degree[0] || !set_chart(x, steps) || !make_round()) return false;
  add_moments();
  std::size_t most_terms = terms_of_degree[0];
  for (const std::size_t terms : terms_of_degree) {
    if (terms <= steps.size()) most_terms = terms;
  }
  factor(most_terms);
  const Coefficients by_a = solved_for(0);
  const Coefficients by_b = solved_for(1);
  // From slopes along a' and b' to the tangent vector.
  const Vec second = (to_round_[1] / scale_) * second_axis_;
  const Vec sheared = (to_round_[1] * shear_ / scale_) * first_axis_;
  const Vec b_slope = second - sheared;
  const Vec a_slope = (to_round_[0] / scale_) * first_axis_;
  for (const auto& [a, b, weight] : points_) {
    weights.push_back((weight * polynomial(by_a, a, b)) * a_slope +
                      (weight * polynomial(by_b, a, b)) * b_slope);
  }
  return true;
}

}  // namespace rondel::interpolation
