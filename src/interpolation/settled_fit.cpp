// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/settled_fit.h"

#include <cmath>
#include <span>

#include "interpolation/local_fit.h"

namespace rondel::interpolation {
namespace {

constexpr std::array<std::size_t, 9> term_degrees = {1, 1, 2, 2, 2, 3, 3, 3, 3};
constexpr std::array<std::size_t, 9> term_powers_of_b = {0, 1, 0, 1, 2, 0, 1, 2, 3};
constexpr std::array<std::array<double, 8>, 8> binomials = {{{1},
                                                             {1, 1},
                                                             {1, 2, 1},
                                                             {1, 3, 3, 1},
                                                             {1, 4, 6, 4, 1},
                                                             {1, 5, 10, 10, 5, 1},
                                                             {1, 6, 15, 20, 15, 6, 1},
                                                             {1, 7, 21, 35, 35, 21, 7, 1}}};

// The highest degree D of monomials for which E_D is bounded.
constexpr std::size_t highest_excess = 4;

// By degree: the least number of neighbors for a polynomial of one variable.
constexpr std::array<std::size_t, 4> min_on_line = {0, 1, 4, 6};

double power(double x, std::size_t n) {
  double result = 1;
  for (std::size_t i = 0; i < n; ++i) result *= x;
  return result;
}

double moment(const FitMoments& moments, std::size_t degree, std::size_t power_of_b) {
  return moments[degree * (degree + 1) / 2 - 3 + power_of_b];
}

// Returns the excess for the monomials in the plane's coordinates over the radius, from the sums
// for those in a and b.
double excess_of_sums(const SettledFit& fit, std::span<const double> of_a,
                      std::span<const double> of_b) {
  const std::size_t degree = of_a.size() - 1;
  const double x_by_a = 1 / (fit.round_a * fit.radius);
  const double y_by_a = fit.shear * x_by_a;
  const double y_by_b = 1 / (fit.round_b * fit.radius);
  double square = 0;
  for (std::size_t k = 0; k <= degree; ++k) {
    double a = 0;
    double b = 0;
    for (std::size_t i = 0; i <= k; ++i) {
      const double factor = binomials[k][i] * power(y_by_a, k - i) * power(y_by_b, i);
      a += factor * of_a[i];
      b += factor * of_b[i];
    }
    const double scale = fit.radius * power(x_by_a, degree - k);
    const double first = scale * (fit.round_a * a - fit.round_b * fit.shear * b);
    const double second = scale * (fit.round_b * b);
    square += first * first + second * second;
  }
  return std::sqrt(square);
}

// Returns E_D for one degree D.
double excess(const SettledFit& fit, std::size_t degree) {
  std::array<double, 5> of_a{};
  std::array<double, 5> of_b{};
  for (std::size_t k = 0; k <= degree; ++k) {
    for (std::size_t t = 0; t < fit.num_terms; ++t) {
      const double sum = moment(fit.moments, degree + term_degrees[t], k + term_powers_of_b[t]);
      of_a[k] += fit.by_a[t] * sum;
      of_b[k] += fit.by_b[t] * sum;
    }
  }
  return excess_of_sums(fit, std::span(of_a).first(degree + 1), std::span(of_b).first(degree + 1));
}

bool is_determined(const SettledFit& fit) {
  for (std::size_t degree = term_degrees[fit.num_terms - 1] + 1; degree <= highest_excess;
       ++degree) {
    if (!(excess(fit, degree) <= max_excess)) return false;
  }
  return gain(fit) <= max_gain;
}

// Solves normal equations of up to five terms by L D L^T; the constructor stops at a pivot that is
// too small.
class NormalEquations {
 public:
  template <class Entry>
  NormalEquations(std::size_t size, const Entry& entry) : size_(size) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) rows_[i][j] = entry(i, j);
    }
  }

  [[nodiscard]] bool factor() {
    for (std::size_t j = 0; j < size_; ++j) {
      double pivot = rows_[j][j];
      const double least = LocalFits::min_pivot * pivot;
      for (std::size_t k = 0; k < j; ++k) pivot -= rows_[j][k] * rows_[j][k] * pivots_[k];
      if (!(pivot > least)) return false;
      pivots_[j] = pivot;
      for (std::size_t i = j + 1; i < size_; ++i) {
        double sum = rows_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= rows_[i][k] * rows_[j][k] * pivots_[k];
        rows_[i][j] = sum / pivot;
      }
    }
    return true;
  }

  // Returns the solution for the right side that is 1 in one place and 0 in the others.
  [[nodiscard]] std::array<double, 5> solution(std::size_t place) const {
    std::array<double, 5> x{};
    x[place] = 1;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= rows_[i][k] * x[k];
    }
    for (std::size_t i = 0; i < size_; ++i) x[i] /= pivots_[i];
    for (std::size_t i = size_; i-- > 0;) {
      for (std::size_t k = i + 1; k < size_; ++k) x[i] -= rows_[k][i] * x[k];
    }
    return x;
  }

 private:
  std::size_t size_;
  std::array<std::array<double, 5>, 5> rows_{};
  std::array<double, 5> pivots_{};
};

bool solve_plane(SettledFit& fit, std::size_t num_terms) {
  NormalEquations equations(num_terms, [&](std::size_t i, std::size_t j) {
    return moment(fit.moments, term_degrees[i] + term_degrees[j],
                  term_powers_of_b[i] + term_powers_of_b[j]);
  });
  if (!equations.factor()) return false;
  fit.num_terms = num_terms;
  fit.by_a = {};
  fit.by_b = {};
  const auto by_a = equations.solution(0);
  const auto by_b = equations.solution(1);
  for (std::size_t t = 0; t < num_terms; ++t) {
    fit.by_a[t] = by_a[t];
    fit.by_b[t] = by_b[t];
  }
  return true;
}

// A coordinate of the plane in units of the radius: by_a a + by_b b.
struct LineCoordinate {
  double by_a;
  double by_b;
};

// Returns the coordinates along the direction in which the cloud is longest, and across it.
std::array<LineCoordinate, 2> axes_of_cloud(const SettledFit& fit) {
  const double a = 1 / fit.round_a;
  const double b = 1 / fit.round_b;
  const double ab = a * b * moment(fit.moments, 2, 1);
  const double xx = a * a * moment(fit.moments, 2, 0);
  const double xy = ab + fit.shear * xx;
  const double yy = b * b * moment(fit.moments, 2, 2) + fit.shear * (ab + xy);
  const double half = (xx - yy) / 2;
  const double root = std::sqrt(half * half + xy * xy);
  double x = half >= 0 ? half + root : xy;
  double y = half >= 0 ? xy : root - half;
  const double length = std::sqrt(x * x + y * y);
  x = length > 0 ? x / length : 1;
  y = length > 0 ? y / length : 0;
  const double unit_a = a / fit.radius;
  const double unit_b = b / fit.radius;
  return {{{(x + fit.shear * y) * unit_a, y * unit_b}, {(fit.shear * x - y) * unit_a, x * unit_b}}};
}

// Returns the sum of weight s^n, where s is the coordinate.
double line_moment(const SettledFit& fit, const LineCoordinate& s, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    sum += binomials[n][i] * power(s.by_a, n - i) * power(s.by_b, i) * moment(fit.moments, n, i);
  }
  return sum;
}

// Returns the sum of weight s^n t.
double mixed_moment(const SettledFit& fit, const LineCoordinate& s, const LineCoordinate& t,
                    std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    sum += binomials[n][i] * power(s.by_a, n - i) * power(s.by_b, i) *
           (t.by_a * moment(fit.moments, n + 1, i) + t.by_b * moment(fit.moments, n + 1, i + 1));
  }
  return sum;
}

// Returns the polynomial c_0 s + c_1 s^2 + c_2 s^3 in terms of a and b.
FitTerms terms_of_line(const LineCoordinate& s, std::span<const double> c) {
  const double u = s.by_a;
  const double v = s.by_b;
  return {c[0] * u,        c[0] * v,         c[1] * u * u,         2 * c[1] * u * v,
          c[1] * v * v,    c[2] * u * u * u, 3 * c[2] * u * u * v, 3 * c[2] * u * v * v,
          c[2] * v * v * v};
}

void settle_on_line(SettledFit& fit) {
  const auto [along, across] = axes_of_cloud(fit);
  std::array<double, 8> sums{};
  for (std::size_t n = 2; n < sums.size(); ++n) sums[n] = line_moment(fit, along, n);
  std::size_t degree = 3;
  while (degree > 1 && fit.num_neighbors < min_on_line[degree]) --degree;
  std::array<double, 5> c{};
  for (; degree > 0; --degree) {
    NormalEquations equations(degree,
                              [&](std::size_t i, std::size_t j) { return sums[i + j + 2]; });
    if (!equations.factor()) continue;
    c = equations.solution(0);
    double too_much = 0;
    double taken = 0;
    for (std::size_t i = 0; i < degree; ++i) {
      too_much += c[i] * sums[i + degree + 2];
      taken += c[i] * mixed_moment(fit, along, across, i + 1);
    }
    if (degree == 1 || (std::abs(too_much) <= max_excess && std::abs(taken) <= max_slope_across &&
                        std::sqrt(fit.mean_weight * c[0]) <= max_gain)) {
      break;
    }
  }
  const FitTerms polynomial = terms_of_line(along, c);
  for (std::size_t t = 0; t < polynomial.size(); ++t) {
    fit.by_a[t] = along.by_a * polynomial[t];
    fit.by_b[t] = along.by_b * polynomial[t];
  }
  fit.num_terms = degree;
  fit.is_plane = false;
}

}  // namespace

double excess_of_cubic(const SettledFit& fit, const CubicExcess& sums) {
  return excess_of_sums(fit, sums.of_a, sums.of_b);
}

// For values with the variances 1 / weight, the slopes along a and b have the variances by_a[0] and
// by_b[1] and the covariance by_a[1].
double gain(const SettledFit& fit) {
  const double of_a = fit.round_a * fit.round_a * fit.by_a[0];
  const double of_both = fit.round_a * fit.round_b * fit.shear * fit.by_a[1];
  const double of_b = fit.round_b * fit.round_b * (1 + fit.shear * fit.shear) * fit.by_b[1];
  return fit.radius * std::sqrt(fit.mean_weight * (of_a - 2 * of_both + of_b));
}

void settle(SettledFit& fit) {
  if (fit.is_plane) {
    const std::size_t first = fit.num_terms;
    for (std::size_t degree = LocalFits::terms_of_degree.size(); degree-- > 0;) {
      const std::size_t num_terms = LocalFits::terms_of_degree[degree];
      if (num_terms > first || (num_terms < first && !solve_plane(fit, num_terms))) continue;
      if (is_determined(fit)) return;
    }
  }
  settle_on_line(fit);
}

}  // namespace rondel::interpolation
