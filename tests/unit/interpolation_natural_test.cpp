// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Natural neighbors against their definition in numbers of 4400 bits, and what must hold of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "interpolation/natural.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/interpolate.h"
#include "support/generators.h"
#include "support/natural_oracle.h"
#include "support/query_oracle.h"
#include "unit/interpolation_support.h"

namespace rondel {
namespace {

using interpolation::Ground;
using interpolation::NaturalKernel;
using interpolation::NaturalMethod;
using interpolation::Row;
using interpolation::TargetPlace;

constexpr double weight_error = 1e-13;

// The place of a target, as interpolation finds it.
TargetPlace place_of(const Ground& ground, const Point& target) {
  query::Cursor cursor;
  cursor.vertex = ground.near(target);
  return {target, exact::unit_vector(target, ground.center()),
          ground.engine().locate(target, cursor)};
}

bool is_for_kernels(const TargetPlace& place) {
  return place.location.where == Where::face || place.location.where == Where::edge;
}

bool is_on_contour(const Ground& ground, const TargetPlace& place) {
  if (place.location.where != Where::edge) return false;
  const auto& [a, b, none] = place.location.sites;
  for (std::size_t f = 0; f < ground.mesh().num_slots(); ++f) {
    const auto& corners = ground.mesh()[static_cast<Index>(f)].vertex;
    if (std::ranges::count(corners, a) + std::ranges::count(corners, b) == 2 &&
        !ground.is_solid(static_cast<Index>(f)))
      return true;
  }
  return false;
}

// On edges, near sites and in circumcenters, too.
std::vector<Point> targets_of(const Triangulation& triangulation, std::span<const Point> sites,
                              test::Random& random) {
  const Point center = triangulation.sphere().center;
  std::vector<Point> targets = test::query_points(sites, center, random);
  const auto directions = circumcenters(triangulation);
  for (int i = 0; i < 6; ++i) {
    const std::size_t f = random.below(triangulation.num_faces());
    const Triple& face = triangulation.faces()[f];
    const Point a = exact::unit_vector(sites[face[0]], center).hi;
    const Point b = exact::unit_vector(sites[face[1]], center).hi;
    const Point c = exact::unit_vector(sites[face[2]], center).hi;
    targets.push_back(center + directions[f]);
    targets.push_back(center + (a + b));
    targets.push_back(center + ((a + b) + c));
    targets.push_back(center + ((a + 0x1p-20 * b) + 0x1p-20 * c));
  }
  std::erase_if(targets, [&](const Point& p) { return p == center; });
  return targets;
}

struct Difference {
  double value = 0;
  std::size_t num_rows = 0;
  void include(double other) { value = std::isnan(other) ? other : std::max(value, other); }
};

double largest_difference(const Row& row, const std::vector<double>& expected) {
  std::vector<double> weights(expected.size());
  for (const auto& [vertex, weight] : row) weights[vertex] += weight;
  double largest = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double difference = std::abs(weights[i] - expected[i]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

void compare(const Ground& ground, const test::NaturalOracle& oracle, const Point& target,
             Difference& difference) {
  const TargetPlace place = place_of(ground, target);
  if (!is_for_kernels(place) || is_on_contour(ground, place)) return;
  const auto gnomonic = oracle.weights(target, test::NaturalPlane::gnomonic);
  const auto stereographic = oracle.weights(target, test::NaturalPlane::stereographic);
  ASSERT_FALSE(gnomonic.sibson.empty()) << "the cell reaches beyond the hemisphere";
  ASSERT_FALSE(stereographic.sibson.empty());
  const auto check = [&](NaturalMethod method, const std::vector<double>& expected) {
    Row row;
    NaturalKernel kernel(ground, method);
    kernel(place, row);
    const double d = largest_difference(row, expected);
    EXPECT_LE(d, weight_error) << "method " << static_cast<int>(method) << ", target " << target.x
                               << " " << target.y << " " << target.z;
    difference.include(d);
  };
  check(NaturalMethod::laplace, gnomonic.laplace);
  check(NaturalMethod::sibson, gnomonic.sibson);
  check(NaturalMethod::planar_sibson, stereographic.sibson);
  ++difference.num_rows;
}

std::size_t largest_degree(const Triangulation& triangulation) {
  std::vector<std::size_t> degrees(triangulation.num_sites());
  for (const Triple& face : triangulation.faces())
    for (const Index corner : face) ++degrees[corner];
  return *std::ranges::max_element(degrees);
}

Difference compare_with_definition(const test::SiteSet& set, std::uint64_t seed, std::size_t step) {
  Difference difference;
  const auto triangulation = delaunay(set.sites, {.sphere = set.sphere});
  if (triangulation.dimension() < 2) return difference;
  // The definition takes the square of a ring's length, in long numbers.
  if (step > 1 && largest_degree(triangulation) > 40) step *= 6;
  const Ground ground(triangulation);
  std::vector<Point> places;
  for (Index v = 0; v < ground.num_vertices(); ++v) places.push_back(ground.point(v));
  const test::NaturalOracle oracle(places, ground.center());
  test::Random random(seed);
  const std::vector<Point> targets = targets_of(triangulation, set.sites, random);
  for (std::size_t i = 0; i < targets.size(); i += step) {
    compare(ground, oracle, targets[i], difference);
  }
  return difference;
}

class interpolation_natural_weights : public testing::TestWithParam<test::Generator> {};

// A scale of the tests above 1 takes all targets, which is minutes.
TEST_P(interpolation_natural_weights, are_those_of_the_definition) {
  const bool is_long = test::scaled(4) > 4;
  for (const std::size_t n : {8U, 50U, 300U}) {
    const std::size_t step = is_long ? 1 : n == 300 || test::is_shortened() ? 13 : 5;
    const Difference difference = compare_with_definition(GetParam().make(n, 3), 7, step);
    RecordProperty("error_over_1e_16_of_" + std::to_string(n),
                   std::to_string(difference.value * 1e16));
    RecordProperty("rows_of_" + std::to_string(n), std::to_string(difference.num_rows));
  }
}

// --- what holds of weights, with Interpolator ---

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
    EXPECT_LE(largest_difference(weights, others), weight_error);
  }
}

TEST(interpolation_natural, the_region_is_that_of_the_query) {
  for (const test::Generator& generator : test::generators()) {
    if (generator.weighted_only) continue;
    const test::SiteSet set = generator.make(60, 9);
    const auto triangulation = delaunay(set.sites, {.sphere = set.sphere});
    if (triangulation.dimension() < 2) continue;
    const Ground ground(triangulation);
    interpolation::NaturalRegion region(ground);
    test::Random random(5);
    for (const Point& target : test::query_points(set.sites, set.sphere.center, random)) {
      const TargetPlace place = place_of(ground, target);
      if (!is_for_kernels(place)) continue;
      region.find(place);
      region.list_faces();
      query::Cursor cursor;
      cursor.vertex = ground.near(target);
      const auto faces = ground.engine().conflict_region(target, cursor);
      ASSERT_EQ(region.faces().size(), faces.size());
      ASSERT_EQ(region.ring().size(), faces.size() + 2);
      EXPECT_EQ(region.ring().front(), std::ranges::min(region.ring()));
      std::set<Index> around(region.ring().begin(), region.ring().end());
      std::set<std::set<Index>> expected;
      std::set<std::set<Index>> found;
      for (const Index f : faces) {
        EXPECT_TRUE(ground.is_solid(f) || is_on_contour(ground, place));
        const auto& corners = ground.mesh()[f].vertex;
        expected.insert({corners.begin(), corners.end()});
      }
      for (const auto& [a, apex, b, parent] : region.faces()) {
        const std::size_t end = b % region.ring().size();
        found.insert({region.ring()[a], region.ring()[apex], region.ring()[end]});
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(around.size(), region.ring().size());
    }
  }
}

std::vector<test::Generator> projected_generators() {
  std::vector<test::Generator> kept;
  std::ranges::copy_if(test::generators(), std::back_inserter(kept),
                       [](const test::Generator& g) { return !g.weighted_only; });
  return kept;
}

INSTANTIATE_TEST_SUITE_P(generators, interpolation_natural_weights,
                         testing::ValuesIn(projected_generators()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace rondel
