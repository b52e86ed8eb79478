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
constexpr double reach = 1.2;
// Of linear, quadratic and cubic fits: one or two more than terms, lest a pair of close sites decide.
constexpr std::array<std::size_t, 3> least_neighbors = {2, 6, 11};

// No neighbor weighs more than one at this part of the radius.
constexpr double least_radius = 0.25;

// Clouds thinner than this, and those whose thinness rounding may have made, are lines.
constexpr double least_thickness = 0x1p-40;
constexpr double least_remainder = 0x1p-30;

// The sum of c_t times term t.
inline double polynomial(const std::array<double, LocalFit::max_terms>& c, double a, double b) {
  const double linear = c[0] * a + c[1] * b;
  const double quadratic = c[2] * (a * a) + c[3] * (a * b) + c[4] * (b * b);
  const double cubic = (a * a) * (c[5] * a + c[6] * b) + (b * b) * (c[7] * a + c[8] * b);
  return (linear + quadratic) + cubic;
}

template <class F>
double sum_of_lanes(const F& four) {
  return (four[0] + four[1]) + (four[2] + four[3]);
}

}  // namespace

bool LocalFit::set_chart(const Vec& x, std::span<const Vec> steps) {
  scale_ = 0;
  for (const Vec& step : steps) scale_ = std::max(scale_, largest_coordinate(step));
  if (!(scale_ >= 0x1p-1000)) return false;
  const double in_scale = 1 / scale_;
  double farthest = 0;
  Vec far{0, 0, 0};
  for (const Vec& step : steps) {
    const Vec scaled_step = in_scale * step;
    const double square = dot(scaled_step, scaled_step);
    if (square > farthest) far = scaled_step;
    farthest = std::max(farthest, square);
  }
  // x.step = -|step|^2 / 2.
  first_axis_ = normalized(far + (farthest * scale_ / 2) * x);
  second_axis_ = cross(x, first_axis_);
  points_.assign((steps.size() + lanes - 1) / lanes, ChartPoints{});
  double largest = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Vec& step = steps[k];
    const double stretch = in_scale / (1 - dot(step, step) / 4);
    const double a = dot(first_axis_, step) * stretch;
    const double b = dot(second_axis_, step) * stretch;
    ChartPoints& points = points_[k / lanes];
    points.a[k % lanes] = a;
    points.b[k % lanes] = b;
    points.weight[k % lanes] = 1;
    largest = std::max(largest, a * a + b * b);
  }
  set_weights(largest);
  return true;
}

void LocalFit::set_weights(double largest_square) {
  const double radius = reach * std::sqrt(largest_square);
  const double least = (least_radius * least_radius) * (radius * radius);
  for (ChartPoints& p : points_) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const double square = p.a[i] * p.a[i] + p.b[i] * p.b[i];
      const double lacking = radius - std::sqrt(square);
      const double root = (lacking * lacking) / std::max(square, least);
      p.weight[i] *= root * root;
    }
  }
}

bool LocalFit::make_round() {
  std::array<Four, 3> sums{};
  for (const ChartPoints& p : points_) {
    for (std::size_t i = 0; i < lanes; ++i) {
      sums[0][i] += p.weight[i] * (p.a[i] * p.a[i]);
      sums[1][i] += p.weight[i] * (p.a[i] * p.b[i]);
      sums[2][i] += p.weight[i] * (p.b[i] * p.b[i]);
    }
  }
  const double aa = sum_of_lanes(sums[0]);
  const double ab = sum_of_lanes(sums[1]);
  const double bb = sum_of_lanes(sums[2]);
  shear_ = ab / aa;
  const double rest = bb - shear_ * ab;
  if (!(rest > least_thickness * least_thickness * aa && rest > least_remainder * bb)) return false;
  to_round_ = {1 / std::sqrt(aa), 1 / std::sqrt(rest)};
  for (ChartPoints& p : points_) {
    for (std::size_t i = 0; i < lanes; ++i) {
      p.b[i] = to_round_[1] * (p.b[i] - shear_ * p.a[i]);
      p.a[i] = to_round_[0] * p.a[i];
    }
  }
  return true;
}

void LocalFit::add_moments() {
  std::array<std::array<Four, 7>, 5> sums{};
  for (const ChartPoints& p : points_) {
    std::array<Four, 7> power{};
    for (std::size_t i = 0; i < lanes; ++i) {
      power[0][i] = p.weight[i] * (p.a[i] * p.a[i]);
      power[1][i] = p.weight[i] * (p.a[i] * p.b[i]);
      power[2][i] = p.weight[i] * (p.b[i] * p.b[i]);
    }
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t i = 0; i < lanes; ++i) sums[0][q][i] += power[q][i];
    }
    for (std::size_t s = 3; s <= 6; ++s) {
      for (std::size_t i = 0; i < lanes; ++i) power[s][i] = power[s - 1][i] * p.b[i];
      for (std::size_t q = 0; q < s; ++q) {
        for (std::size_t i = 0; i < lanes; ++i) power[q][i] *= p.a[i];
      }
      for (std::size_t q = 0; q <= s; ++q) {
        for (std::size_t i = 0; i < lanes; ++i) sums[s - 2][q][i] += power[q][i];
      }
    }
  }
  for (std::size_t s = 2; s <= 6; ++s) {
    for (std::size_t q = 0; q <= s; ++q) moments_[s - 2][q] = sum_of_lanes(sums[s - 2][q]);
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
  for (std::size_t i = 0; i < terms_of_degree.size(); ++i) {
    if (steps.size() >= least_neighbors[i]) most_terms = terms_of_degree[i];
  }
  factor(most_terms);
  const Coefficients by_a = solved_for(0);
  const Coefficients by_b = solved_for(1);
  // From slopes along a' and b' to the tangent vector.
  const Vec second = (to_round_[1] / scale_) * second_axis_;
  const Vec sheared = (to_round_[1] * shear_ / scale_) * first_axis_;
  const Vec b_slope = second - sheared;
  const Vec a_slope = (to_round_[0] / scale_) * first_axis_;
  for (ChartPoints& p : points_) {
    Four along_a{};
    Four along_b{};
    for (std::size_t i = 0; i < lanes; ++i) {
      along_a[i] = p.weight[i] * polynomial(by_a, p.a[i], p.b[i]);
      along_b[i] = p.weight[i] * polynomial(by_b, p.a[i], p.b[i]);
    }
    p.a = along_a;
    p.b = along_b;
  }
  weights.resize(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const ChartPoints& p = points_[k / lanes];
    weights[k] = p.a[k % lanes] * a_slope + p.b[k % lanes] * b_slope;
  }
  return true;
}

}  // namespace rondel::interpolation
