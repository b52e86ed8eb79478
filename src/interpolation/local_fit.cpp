// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/local_fit.h"

#include <cmath>

#include "interpolation/fit_chart.h"
#include "interpolation/fit_equations.h"
#include "interpolation/fit_lanes.h"
#include "interpolation/fit_moments.h"
#include "interpolation/settled_fit.h"
#include "system/wide_vectors.h"

namespace rondel::interpolation {
namespace fits {
namespace {

// Vertices that are closer than its reciprocal have no gradient, since it might overflow.
constexpr double largest_gradient_weight = 0x1p500;

// Changes the slopes along a' and b' into the tangent vector.
RONDEL_ALWAYS_INLINE inline void set_gradient_weights(Fit& fit, const Solution& solution) {
  LaneVectors along_a;
  LaneVectors along_b;
  const LaneVectors& first = fit.first_axis;
  const LaneVectors& second = fit.second_axis;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    const double in_a = fit.round_a[i] / fit.scale[i];
    const double in_b = fit.round_b[i] / fit.scale[i];
    const double sheared = in_b * fit.shear[i];
    along_a.x[i] = in_a * first.x[i];
    along_a.y[i] = in_a * first.y[i];
    along_a.z[i] = in_a * first.z[i];
    along_b.x[i] = in_b * second.x[i] - sheared * first.x[i];
    along_b.y[i] = in_b * second.y[i] - sheared * first.y[i];
    along_b.z[i] = in_b * second.z[i] - sheared * first.z[i];
  }
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double a = p.z[i] * polynomial(solution.by_a, i, p.x[i], p.y[i]);
      const double b = p.z[i] * polynomial(solution.by_b, i, p.x[i], p.y[i]);
      p.x[i] = a * along_a.x[i] + b * along_b.x[i];
      p.y[i] = a * along_a.y[i] + b * along_b.y[i];
      p.z[i] = a * along_a.z[i] + b * along_b.z[i];
      const double sum = std::fabs(p.x[i]) + std::fabs(p.y[i]) + std::fabs(p.z[i]);
      fit.is_found[i] = sum <= largest_gradient_weight ? fit.is_found[i] : 0.0;
    }
  }
}

// The sums for excess_of_cubic(), one entry a monomial.
struct LaneExcess {
  system::PlainArray<Lanes, 5> of_a{};
  system::PlainArray<Lanes, 5> of_b{};
};
RONDEL_ALWAYS_INLINE inline void add_excess(const Moments& moments, const Solution& s,
                                            LaneExcess& sums) {
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t t = 0; t < max_terms; ++t) {
      const Lanes& moment = moments[first_of(4 + degrees[t]) + k + powers_of_b[t]];
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
        sums.of_a[k][l] += s.by_a[t][l] * moment[l];
        sums.of_b[k][l] += s.by_b[t][l] * moment[l];
      }
    }
  }
}

// Settles the fits whose neighbors do not determine the tried degree, one after the other, since
// they are few.
void settle_lanes(Fit& fit, const Moments& moments, const LaneExcess& sums, Solution& s) {
  for (std::size_t l = 0; l < lanes; ++l) {
    if (fit.counts[l] == 0 || !(fit.scale[l] >= min_scale)) {
      fit.is_found[l] = 0;
      continue;
    }
    SettledFit one{.moments = {},
                   .round_a = fit.round_a[l],
                   .round_b = fit.round_b[l],
                   .shear = fit.shear[l],
                   .radius = std::sqrt(fit.largest[l]),
                   .mean_weight = fit.mean_weight[l],
                   .num_neighbors = static_cast<std::size_t>(fit.counts[l]),
                   .is_plane = fit.is_found[l] != 0,
                   .num_terms = static_cast<std::size_t>(fit.num_terms[l]),
                   .by_a = {},
                   .by_b = {}};
    for (std::size_t t = 0; t < max_terms; ++t) {
      one.by_a[t] = s.by_a[t][l];
      one.by_b[t] = s.by_b[t][l];
    }
    if (one.is_plane && one.num_terms == max_terms) {
      CubicExcess of_lane{};
      for (std::size_t k = 0; k < 5; ++k) {
        of_lane.of_a[k] = sums.of_a[k][l];
        of_lane.of_b[k] = sums.of_b[k][l];
      }
      if (excess_of_cubic(one, of_lane) <= max_excess && gain(one) <= max_gain) continue;
    }
    for (std::size_t k = 0; k < num_moments; ++k) one.moments[k] = moments[k][l];
    const std::size_t tried = one.num_terms;
    settle(one);
    if (one.is_plane && one.num_terms == tried) continue;
    for (std::size_t t = 0; t < max_terms; ++t) {
      s.by_a[t][l] = one.by_a[t];
      s.by_b[t][l] = one.by_b[t];
    }
    fit.num_terms[l] = static_cast<double>(one.num_terms);
    fit.is_line[l] = one.is_plane ? 0 : 1;
    fit.is_found[l] = one.is_plane || fit.with_lines ? 1 : 0;
  }
}

RONDEL_ALWAYS_INLINE inline void find_in_lanes(Fit& fit) {
  set_axes(fit);
  set_chart(fit);
  set_weights(fit);
  Moments moments{};
  add_moments(fit, moments);
  Solution solution;
  for (std::size_t i = 0; i < max_terms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) solution.rows[i][j] = moments[moment_of(i, j)];
    solution.diagonal[i] = moments[moment_of(i, i)];
  }
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    solution.by_a[0][l] = 1;
    solution.by_b[1][l] = 1;
  }
  factor(solution);
  keep_terms(fit, solution);
  LaneExcess sums;
  add_excess(moments, solution, sums);
  settle_lanes(fit, moments, sums, solution);
  set_gradient_weights(fit, solution);
}

}  // namespace
}  // namespace fits

void LocalFits::start(std::size_t max_neighbors) {
  // The number is even, because moments are summed up in pairs.
  points_.assign(max_neighbors + max_neighbors % 2, LaneVectors{});
  counts_ = {};
  sites_ = {};
}

void LocalFits::set_site(std::size_t lane, const Vec& x, std::size_t num_neighbors) {
  sites_.x[lane] = x.x;
  sites_.y[lane] = x.y;
  sites_.z[lane] = x.z;
  counts_[lane] = static_cast<double>(num_neighbors);
}

void LocalFits::find(bool with_lines) {
  fits::Fit fit{points_.data(), points_.size(), sites_, counts_};
  fit.with_lines = with_lines;
  system::with_wide_vectors([&fit]() RONDEL_ALWAYS_INLINE { fits::find_in_lanes(fit); });
  num_terms_ = fit.num_terms;
  is_found_ = fit.is_found;
  is_line_ = fit.is_line;
}

LocalFits::LaneVectors LocalFits::gradients(const std::vector<Lanes>& values,
                                            const Lanes& here) const {
  LaneVectors sums{};
  const Lanes* const numbers = values.data();
  const LaneVectors* const points = points_.data();
  const std::size_t size = points_.size();
  const Lanes counts = counts_;
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    LaneVectors sum{};
    for (std::size_t k = 0; k < size; ++k) {
      const auto number = static_cast<double>(k);
      RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
        const double difference = number < counts[i] ? numbers[k][i] - here[i] : 0.0;
        sum.x[i] += difference * points[k].x[i];
        sum.y[i] += difference * points[k].y[i];
        sum.z[i] += difference * points[k].z[i];
      }
    }
    sums = sum;
  });
  return sums;
}

}  // namespace rondel::interpolation
