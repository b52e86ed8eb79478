// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The laws of natural neighbors hold for the weights that Interpolator returns.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/interpolate.h"
#include "support/generators.h"
#include "unit/interpolation/support.h"

namespace rondel {
namespace {

using test::row_of;

constexpr std::array natural_methods = {Method::laplace, Method::sibson};

// Random, in sites, on edges, in circumcenters.
std::vector<Point> some_targets(const Triangulation& triangulation, std::size_t count) {
  test::Random random(17);
  std::vector<Point> targets;
  const auto directions = circumcenters(triangulation);
  while (targets.size() < count) {
    const std::size_t f = random.below(triangulation.num_faces());
    const Triple& face = triangulation.faces()[f];
    const auto site = [&](std::size_t i) { return triangulation.sites().points()[face[i]]; };
    const double share = random.unit();
    targets.push_back(random.direction());
    targets.push_back(site(0));
    targets.push_back(site(1) + site(2));
    targets.push_back(directions[f]);
    targets.push_back((site(0) + share * site(1)) + (share * share) * site(2));
  }
  return targets;
}

// |1 - sum of weights| and |u x sum of weights times sites|.
void check_row(const Triangulation& triangulation, const Point& target, test::WeightRow row) {
  using test::Real;
  Real sum;
  test::RealVector mean;
  for (std::size_t k = 0; k < row.values.size(); ++k) {
    const Real weight(row.values[k]);
    const auto x = test::normalized(test::to_real(triangulation.sites().points()[row.columns[k]]));
    sum = sum + weight;
    for (std::size_t i = 0; i < 3; ++i) mean[i] = mean[i] + weight * x.value()[i];
    EXPECT_GT(row.values[k], 0);
  }
  EXPECT_LE(std::abs((sum - Real(1)).rounded()), 4 * test::ulp);
  const auto across = test::cross(test::normalized(test::to_real(target)).value(), mean);
  EXPECT_LE(sqrt(test::dot(across, across)).rounded(), 1e-14);
}

TEST(interpolation_natural, weights_sum_up_to_1_and_their_mean_is_on_the_ray) {
  for (const char* name : {"uniform", "globe_grid", "patch_1e_6", "s_n", "falling_spiral"}) {
    const test::SiteSet set = test::generator(name).make(1 << 14, 2);
    const auto triangulation = delaunay(set.sites, {.sphere = set.sphere});
    const auto targets = some_targets(triangulation, test::scaled(30));
    const Interpolator interpolator(triangulation);
    for (const Method method : natural_methods) {
      SCOPED_TRACE(name);
      const Weights weights = interpolator.weights(targets, {.method = method});
      for (std::size_t t = 0; t < targets.size(); ++t) {
        const test::WeightRow row = row_of(weights, t);
        if (!row.values.empty()) check_row(triangulation, targets[t], row);
      }
    }
  }
}

// Weights by site, of a target.
using Dense = std::vector<double>;
Dense dense_row(const Weights& weights, std::size_t t) {
  Dense row(weights.num_columns);
  const test::WeightRow sparse = row_of(weights, t);
  for (std::size_t k = 0; k < sparse.values.size(); ++k) row[sparse.columns[k]] = sparse.values[k];
  return row;
}

double largest_difference(const Weights& a, const Weights& b) {
  double largest = 0;
  for (std::size_t t = 0; t < a.num_rows(); ++t) {
    const Dense x = dense_row(a, t);
    const Dense y = dense_row(b, t);
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  }
  return largest;
}

template <class Move>
std::vector<Point> moved(std::span<const Point> points, const Move& move) {
  std::vector<Point> result;
  for (const Point& p : points) result.push_back(move(p));
  return result;
}

TEST(interpolation_natural, weights_turn_with_the_sites) {
  constexpr std::size_t n = 1000;
  constexpr double spacing = 0.1;
  test::Random random(23);
  const Point x = random.direction();
  const Point y = test::normalized(test::cross_product(random.direction(), x));
  const Point z = test::cross_product(x, y);
  const auto turn = [&](const Point& p) { return (p.x * x + p.y * y) + p.z * z; };
  const auto sites = test::generator("uniform").make(n, 4).sites;
  const auto targets = test::generator("uniform").make(n, 5).sites;
  for (const Method method : natural_methods) {
    const auto weights = Interpolator(delaunay(sites)).weights(targets, {.method = method});
    const auto turned = Interpolator(delaunay(moved(sites, turn)))
                            .weights(moved(targets, turn), {.method = method});
    EXPECT_LE(largest_difference(weights, turned), 1e-13 / spacing);
  }
}

// Ties are broken by coordinates, so the mirrored grid gets other diagonals.
TEST(interpolation_natural, diagonals_of_cocircular_sites_have_no_effect) {
  const auto mirror = [](const Point& p) { return Point{-p.x, p.y, p.z}; };
  const auto sites = test::generator("globe_grid").make(500, 1).sites;
  const auto triangulation = delaunay(sites);
  const auto mirrored = delaunay(moved(sites, mirror));
  const auto edges_of = [](const Triangulation& t) {
    std::set<std::pair<Index, Index>> found;
    for (const auto& [a, b] : edges(t)) found.insert(std::minmax(a, b));
    return found;
  };
  ASSERT_NE(edges_of(triangulation), edges_of(mirrored));
  const auto targets = some_targets(triangulation, test::scaled(500));
  for (const Method method : natural_methods) {
    const auto weights = Interpolator(triangulation).weights(targets, {.method = method});
    const auto others = Interpolator(mirrored).weights(moved(targets, mirror), {.method = method});
    EXPECT_LE(largest_difference(weights, others), 1e-13);
  }
}

}  // namespace
}  // namespace rondel
