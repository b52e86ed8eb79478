// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/local_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpolation/settled_fit.h"
#include "system/wide_vectors.h"

namespace rondel::interpolation {
namespace {

constexpr std::size_t lanes = LocalFits::lanes;
constexpr std::size_t max_terms = LocalFits::max_terms;
using Lanes = LocalFits::Lanes;
using LaneVectors = LocalFits::LaneVectors;
using Terms = system::PlainArray<Lanes, max_terms>;

// Degree and power of b of the terms a, b, a^2, ab, b^2, a^3 ...
constexpr system::PlainArray<std::size_t, max_terms> degrees = {1, 1, 2, 2, 2, 3, 3, 3, 3};
constexpr system::PlainArray<std::size_t, max_terms> powers_of_b = {0, 1, 0, 1, 2, 0, 1, 2, 3};

// The radius at which weights vanish, over the distance of the farthest neighbor.
constexpr double reach = 1.2;
// Of linear, quadratic and cubic fits: one or two more than terms, lest a pair of close sites decide.
constexpr system::PlainArray<double, 3> least_neighbors = {2, 6, 11};

// No neighbor weighs more than one at this part of the radius.
constexpr double least_radius = 0.25;

// Nearer ones are in the same place.
constexpr double least_scale = 0x1p-1000;
// Clouds thinner than this, and those whose thinness rounding may have made, are lines.
constexpr double least_thickness = 0x1p-40;
constexpr double least_remainder = 0x1p-30;

// Of vertices closer than its reciprocal no gradient can be had: it would not be a number.
constexpr double largest_gradient_weight = 0x1p500;

// As std::max() and std::min(), which are not always inline.
RONDEL_ALWAYS_INLINE inline double larger(double a, double b) { return a < b ? b : a; }
RONDEL_ALWAYS_INLINE inline double smaller(double a, double b) { return b < a ? b : a; }

// Without a branch.
RONDEL_ALWAYS_INLINE inline bool both(bool a, bool b) {
  return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0;
}

// The moments of degree s begin here, a^s first.
RONDEL_ALWAYS_INLINE constexpr std::size_t first_of(std::size_t s) { return (s * (s + 1)) / 2 - 3; }
constexpr std::size_t num_moments = first_of(8);
static_assert(num_moments == num_fit_moments);

// That of the product of two terms.
RONDEL_ALWAYS_INLINE constexpr std::size_t moment_of(std::size_t i, std::size_t j) {
  return first_of(degrees[i] + degrees[j]) + powers_of_b[i] + powers_of_b[j];
}

using Products = system::PlainArray<double, num_moments>;

// Those of degree s from those of s - 1.
template <std::size_t S, std::size_t... Q>
RONDEL_ALWAYS_INLINE inline void raise(double a, double b, std::index_sequence<Q...> /*powers*/,
                                       Products& products) {
  ((products[first_of(S) + Q] = products[first_of(S - 1) + Q] * a), ...);
  products[first_of(S) + S] = products[first_of(S - 1) + S - 1] * b;
}

// The weighted a^(s-q) b^q of one neighbor, s = 2 ... 7.
RONDEL_ALWAYS_INLINE inline Products products_of(double weight, double a, double b) {
  Products products;
  products[0] = weight * (a * a);
  products[1] = weight * (a * b);
  products[2] = weight * (b * b);
  raise<3>(a, b, std::make_index_sequence<3>(), products);
  raise<4>(a, b, std::make_index_sequence<4>(), products);
  raise<5>(a, b, std::make_index_sequence<5>(), products);
  raise<6>(a, b, std::make_index_sequence<6>(), products);
  raise<7>(a, b, std::make_index_sequence<7>(), products);
  return products;
}

// The sum of c_t times term t.
RONDEL_ALWAYS_INLINE inline double polynomial(const Terms& c, std::size_t lane, double a,
                                              double b) {
  const double linear = c[0][lane] * a + c[1][lane] * b;
  const double quadratic = c[2][lane] * (a * a) + c[3][lane] * (a * b) + c[4][lane] * (b * b);
  const double cubic =
      (a * a) * (c[5][lane] * a + c[6][lane] * b) + (b * b) * (c[7][lane] * a + c[8][lane] * b);
  return (linear + quadratic) + cubic;
}

// What find() works on, apart from the object, so that a compiler knows that nothing of it is anything
// else.
struct Fit {
  LaneVectors* points;
  std::size_t size;
  LaneVectors sites;
  Lanes counts;
  Lanes num_terms{};
  Lanes is_found{};
  Lanes is_line{};
  bool with_lines = true;
  Lanes scale{};  // the unit of the plane's coordinates
  Lanes farthest{};
  LaneVectors first_axis{};
  LaneVectors second_axis{};
  Lanes largest{};
  // a' = round_a a,  b' = round_b (b - shear a)
  Lanes round_a{};
  Lanes round_b{};
  Lanes shear{};
};

using Moments = system::PlainArray<Lanes, num_moments>;

// Of the equations for the weights of the slopes along a' and b': the left side, and what solves it.
struct Solution {
  system::PlainArray<Terms, max_terms> rows;
  Terms diagonal;
  Terms of_pivots;  // their reciprocals
  Terms by_a{};
  Terms by_b{};
};

// Steps in units of the largest coordinate; the first axis points to the farthest.
RONDEL_ALWAYS_INLINE inline void set_axes(Fit& fit) {
  for (std::size_t k = 0; k < fit.size; ++k) {
    const LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double xy = larger(std::fabs(p.x[i]), std::fabs(p.y[i]));
      fit.scale[i] = larger(fit.scale[i], larger(xy, std::fabs(p.z[i])));
    }
  }
  Lanes in_scale;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    in_scale[i] = 1 / (fit.scale[i] > least_scale ? fit.scale[i] : 1.0);
  }
  LaneVectors far{};
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      p.x[i] *= in_scale[i];
      p.y[i] *= in_scale[i];
      p.z[i] *= in_scale[i];
      const double square = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
      const bool is_farther = square > fit.farthest[i];
      far.x[i] = is_farther ? p.x[i] : far.x[i];
      far.y[i] = is_farther ? p.y[i] : far.y[i];
      far.z[i] = is_farther ? p.z[i] : far.z[i];
      fit.farthest[i] = is_farther ? square : fit.farthest[i];
    }
  }
  LaneVectors& first = fit.first_axis;
  LaneVectors& second = fit.second_axis;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    // x.step = -|step|^2 / 2.
    const double up = fit.farthest[i] * fit.scale[i] / 2;
    const double x = far.x[i] + up * fit.sites.x[i];
    const double y = far.y[i] + up * fit.sites.y[i];
    const double z = far.z[i] + up * fit.sites.z[i];
    const double length = std::sqrt(x * x + y * y + z * z);
    first.x[i] = x / length;
    first.y[i] = y / length;
    first.z[i] = z / length;
    second.x[i] = fit.sites.y[i] * first.z[i] - fit.sites.z[i] * first.y[i];
    second.y[i] = fit.sites.z[i] * first.x[i] - fit.sites.x[i] * first.z[i];
    second.z[i] = fit.sites.x[i] * first.y[i] - fit.sites.y[i] * first.x[i];
  }
}

RONDEL_ALWAYS_INLINE inline void set_chart(Fit& fit) {
  const LaneVectors& first = fit.first_axis;
  const LaneVectors& second = fit.second_axis;
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double square = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
      const double stretch = 1 / (1 - square * (fit.scale[i] * fit.scale[i]) / 4);
      const double a = (first.x[i] * p.x[i] + first.y[i] * p.y[i] + first.z[i] * p.z[i]) * stretch;
      const double b =
          (second.x[i] * p.x[i] + second.y[i] * p.y[i] + second.z[i] * p.z[i]) * stretch;
      p.x[i] = a;
      p.y[i] = b;
      fit.largest[i] = larger(fit.largest[i], a * a + b * b);
    }
  }
}

// And what makes the cloud round. What fills up a lane lies at (0, 0), where no term and no moment has a value.
RONDEL_ALWAYS_INLINE inline void set_weights(Fit& fit) {
  Lanes radius;
  Lanes least;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    radius[i] = reach * std::sqrt(fit.largest[i]);
    least[i] = (least_radius * least_radius) * (radius[i] * radius[i]);
  }
  Lanes aa{};
  Lanes ab{};
  Lanes bb{};
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double a = p.x[i];
      const double b = p.y[i];
      const double square = a * a + b * b;
      const double lacking = radius[i] - std::sqrt(square);
      const double root = (lacking * lacking) / larger(square, least[i]);
      const double weight = root * root;
      p.z[i] = weight;
      aa[i] += weight * (a * a);
      ab[i] += weight * (a * b);
      bb[i] += weight * (b * b);
    }
  }
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    fit.shear[i] = ab[i] / aa[i];
    const double rest = bb[i] - fit.shear[i] * ab[i];
    const bool is_plane = both(
        both(rest > (least_thickness * least_thickness) * aa[i], rest > least_remainder * bb[i]),
        fit.scale[i] >= least_scale);
    fit.is_found[i] = is_plane ? 1.0 : 0.0;
    fit.round_a[i] = 1 / std::sqrt(aa[i]);
    fit.round_b[i] = 1 / std::sqrt(is_plane ? rest : 1.0);
  }
}

RONDEL_ALWAYS_INLINE inline void add_moments(const Fit& fit, Moments& moments) {
  const auto add =
      [&moments]<std::size_t... M>(std::size_t i, const Products& p, const Products& q,
                                   std::index_sequence<M...> /*all*/) RONDEL_ALWAYS_INLINE {
    ((moments[M][i] += p[M] + q[M]), ...);
  };
  for (std::size_t k = 0; k < fit.size; k += 2) {
    LaneVectors& p = fit.points[k];
    LaneVectors& q = fit.points[k + 1];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      p.y[i] = fit.round_b[i] * (p.y[i] - fit.shear[i] * p.x[i]);
      p.x[i] = fit.round_a[i] * p.x[i];
      q.y[i] = fit.round_b[i] * (q.y[i] - fit.shear[i] * q.x[i]);
      q.x[i] = fit.round_a[i] * q.x[i];
    }
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      add(i, products_of(p.z[i], p.x[i], p.y[i]), products_of(q.z[i], q.x[i], q.y[i]),
          std::make_index_sequence<num_moments>());
    }
  }
}

// rows[i][j], j < i: L; where a pivot is too small, its column is 0. The right sides, which are e_0 and e_1, become L^-1 of them.
RONDEL_ALWAYS_INLINE inline void factor(Solution& s) {
  for (std::size_t j = 0; j < max_terms; ++j) {
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double pivot = s.rows[j][j][l];
      const double reciprocal = 1 / pivot;
      s.of_pivots[j][l] = pivot > LocalFits::least_pivot * s.diagonal[j][l] ? reciprocal : 0.0;
    }
    for (std::size_t i = max_terms; --i > j;) {
      Lanes factors;
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) factors[l] =
          s.rows[i][j][l] * s.of_pivots[j][l];
      for (std::size_t k = j + 1; k <= i; ++k) {
        RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) s.rows[i][k][l] -=
            factors[l] * s.rows[k][j][l];
      }
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
        s.rows[i][j][l] = factors[l];
        s.by_a[i][l] -= factors[l] * s.by_a[j][l];
        s.by_b[i][l] -= factors[l] * s.by_b[j][l];
      }
    }
  }
}

// Up to the last degree at whose end no pivot is too small.
RONDEL_ALWAYS_INLINE inline void keep_terms(Fit& fit, Solution& s) {
  constexpr auto linear = static_cast<double>(LocalFits::terms_of_degree[0]);
  constexpr auto quadratic = static_cast<double>(LocalFits::terms_of_degree[1]);
  constexpr auto cubic = static_cast<double>(LocalFits::terms_of_degree[2]);
  RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
    const double most = fit.counts[l] >= least_neighbors[1] ? quadratic : linear;
    fit.num_terms[l] = fit.counts[l] >= least_neighbors[2] ? cubic : most;
    fit.is_found[l] = fit.counts[l] >= least_neighbors[0] ? fit.is_found[l] : 0.0;
  }
  for (std::size_t i = max_terms; i-- > LocalFits::terms_of_degree[0];) {
    const double before = i < LocalFits::terms_of_degree[1] ? linear : quadratic;
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double most = smaller(fit.num_terms[l], before);
      fit.num_terms[l] = s.of_pivots[i][l] != 0 ? fit.num_terms[l] : most;
    }
  }
  for (std::size_t i = 0; i < max_terms; ++i) {
    const auto term = static_cast<double>(i);
    RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
      const double factor = term < fit.num_terms[l] ? s.of_pivots[i][l] : 0.0;
      s.by_a[i][l] *= factor;
      s.by_b[i][l] *= factor;
    }
  }
  for (std::size_t i = max_terms; i-- > 0;) {
    for (std::size_t k = 0; k < i; ++k) {
      RONDEL_KEEP_LOOP for (std::size_t l = 0; l < lanes; ++l) {
        s.by_a[k][l] -= s.rows[i][k][l] * s.by_a[i][l];
        s.by_b[k][l] -= s.rows[i][k][l] * s.by_b[i][l];
      }
    }
  }
}

// From slopes along a' and b' to the tangent vector.
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

// The sums of excess_of_cubic(), a monomial in each row.
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

// Fits of which the neighbors determine less than was tried, one after the other: they are few.
void settle_lanes(Fit& fit, const Moments& moments, const LaneExcess& sums, Solution& s) {
  for (std::size_t l = 0; l < lanes; ++l) {
    if (fit.counts[l] == 0 || !(fit.scale[l] >= least_scale)) {
      fit.is_found[l] = 0;
      continue;
    }
    SettledFit one{.moments = {},
                   .round_a = fit.round_a[l],
                   .round_b = fit.round_b[l],
                   .shear = fit.shear[l],
                   .radius = std::sqrt(fit.largest[l]),
                   .num_neighbors = static_cast<std::size_t>(fit.counts[l]),
                   .is_plane = fit.is_found[l] != 0,
                   .num_terms = static_cast<std::size_t>(fit.num_terms[l]),
                   .by_a = {},
                   .by_b = {}};
    if (one.is_plane && one.num_terms == max_terms) {
      CubicExcess of_lane{};
      for (std::size_t k = 0; k < 5; ++k) {
        of_lane.of_a[k] = sums.of_a[k][l];
        of_lane.of_b[k] = sums.of_b[k][l];
      }
      if (excess_of_cubic(one, of_lane) <= most_excess) continue;
    }
    for (std::size_t k = 0; k < num_moments; ++k) one.moments[k] = moments[k][l];
    for (std::size_t t = 0; t < max_terms; ++t) {
      one.by_a[t] = s.by_a[t][l];
      one.by_b[t] = s.by_b[t][l];
    }
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

void LocalFits::start(std::size_t most_neighbors) {
  // Moments are added up in pairs.
  points_.assign(most_neighbors + most_neighbors % 2, LaneVectors{});
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
  Fit fit{points_.data(), points_.size(), sites_, counts_};
  fit.with_lines = with_lines;
  system::with_wide_vectors([&fit]() RONDEL_ALWAYS_INLINE { find_in_lanes(fit); });
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
