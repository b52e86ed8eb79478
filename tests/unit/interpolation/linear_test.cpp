// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Linear weights against determinants in many bits, and the laws that need no oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "rondel/query.h"
#include "unit/interpolation/support.h"

namespace rondel::test {
namespace {

constexpr InterpolationOptions linear = {.method = Method::linear, .hashes = false};

// The exact weights of the sites of a location, from their determinants with u; on an edge from the
// lengths of cross products.
std::map<Index, Real> exact_weights(const Location& location, const SiteSet& set,
                                    const Point& target) {
  const auto direction = [&](Index i) { return real_direction(set.sites[i], set.sphere.center); };
  const auto& [a, b, c] = location.sites;
  const RealVector u = real_direction(target, set.sphere.center);
  std::map<Index, Real> weights;
  if (location.where == Where::vertex) weights[a] = Real(1);
  if (location.where == Where::edge) {
    const RealVector from_b = test::cross(u, direction(b));
    const RealVector from_a = test::cross(u, direction(a));
    weights[a] = sqrt(test::dot(from_b, from_b));
    weights[b] = sqrt(test::dot(from_a, from_a));
  }
  if (location.where == Where::face) {
    weights[a] = test::dot(u, test::cross(direction(b), direction(c)));
    weights[b] = test::dot(u, test::cross(direction(c), direction(a)));
    weights[c] = test::dot(u, test::cross(direction(a), direction(b)));
  }
  Real sum(0);
  for (const auto& [site, weight] : weights) sum = sum + weight;
  for (auto& [site, weight] : weights) weight = weight / sum;
  return weights;
}

void expect_exact(const WeightRow& row, const std::map<Index, Real>& exact, double most,
                  const std::string& name) {
  ASSERT_EQ(row.columns.size(), exact.size()) << name;
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    ASSERT_TRUE(exact.contains(row.columns[k])) << name;
    const double error = (Real(row.values[k]) - exact.at(row.columns[k])).rounded();
    ASSERT_LE(std::abs(error), most) << name << ": weight " << row.values[k];
  }
}

// True if a face of the location, or the one behind its edge, is at most 2^-49 high above its longest
// side, and has no short side: there rows are those of edges (flat_faces_test.cpp).
bool is_flat(const InterpolationCase& c, const Location& location) {
  const auto direction = [&](Index i) {
    return real_direction(c.set.sites[i], c.set.sphere.center);
  };
  const auto length = [](const RealVector& v) { return sqrt(test::dot(v, v)).rounded(); };
  return std::ranges::any_of(c.triangulation.faces(), [&](const Triple& face) {
    const auto has = [&](Index site) { return site == no_index || std::ranges::count(face, site); };
    if (!std::ranges::all_of(location.sites, has)) return false;
    const std::array<RealVector, 3> x = {direction(face[0]), direction(face[1]),
                                         direction(face[2])};
    double shortest = 2;
    double height = 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const RealVector& a = x[(i + 1) % 3];
      const RealVector normal = test::cross(a, x[(i + 2) % 3]);
      shortest = std::min(shortest, length(a - x[(i + 2) % 3]));
      height = std::min(height, std::abs(test::dot(x[i], normal).rounded()) / length(normal));
    }
    return height <= 0x1p-49 && shortest > 0x1p-29;
  });
}

TEST(interpolation_linear, weights_are_right_for_every_kind_of_sites) {
  std::set<Where> met;
  for_each_interpolation_case(40, [&met](const InterpolationCase& c) {
    const Weights weights = Interpolator(c.triangulation).weights(c.targets, linear);
    const std::vector<Location> locations = Locator(c.triangulation).locate(c.targets);
    ASSERT_EQ(weights.num_rows(), c.targets.size());
    ASSERT_EQ(weights.num_columns, c.set.sites.size());
    for (std::size_t t = 0; t < c.targets.size(); ++t) {
      const std::string name = c.name + " target " + std::to_string(t);
      met.insert(locations[t].where);
      const WeightRow row = row_of(weights, t);
      if (locations[t].face == no_index || locations[t].where == Where::vertex ||
          !is_flat(c, locations[t])) {
        expect_exact(row, exact_weights(locations[t], c.set, c.targets[t]), 1e-13, name);
      }
      for (const double weight : row.values) ASSERT_GE(weight, 0) << name;
      if (row.values.empty()) continue;
      const WeightErrors errors = weight_errors(row, c.set, c.targets[t]);
      ASSERT_LE(std::abs(errors.unity), 4 * ulp) << name;
      ASSERT_LE(errors.direction, 1e-14) << name;
    }
  });
  EXPECT_EQ(met.size(), 4U);
}

TEST(interpolation_linear, weights_of_faces_of_a_good_shape_are_right_to_4_ulp) {
  const SiteSet set{inputs::make(*inputs::find_kind("fibonacci"), {.n = 300}).sites};
  Random random(4);
  std::vector<Point> targets;
  for (std::size_t i = 0; i < scaled(500); ++i) targets.push_back(random.direction());
  const Triangulation triangulation = delaunay(set.sites);
  const Weights weights = Interpolator(triangulation).weights(targets, linear);
  const Locator locator(triangulation);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    expect_exact(row_of(weights, t), exact_weights(locator.locate(targets[t]), set, targets[t]),
                 4 * ulp, std::to_string(t));
  }
}

TEST(interpolation_linear, unity_and_direction_hold_in_patches_of_any_size) {
  Random random(7);
  for (const double radius : {1e-2, 1e-6, 1e-9, 1e-12, 1e-14}) {
    SiteSet set;
    const Point pole = random.direction();
    for (int i = 0; i < 200; ++i) set.sites.push_back(random_near(random, pole, radius));
    std::vector<Point> targets;
    for (int i = 0; i < 100; ++i) targets.push_back(random_near(random, pole, radius / 2));
    const Weights weights = Interpolator(delaunay(set.sites)).weights(targets, linear);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (row_of(weights, t).values.empty()) continue;
      const WeightErrors errors = weight_errors(row_of(weights, t), set, targets[t]);
      ASSERT_LE(std::abs(errors.unity), 4 * ulp) << radius;
      ASSERT_LE(errors.direction, 1e-14 * radius) << radius;
    }
  }
}

TEST(interpolation_linear, a_linear_function_comes_back_on_planes) {
  // f = a + g.x is answered a + r g.u, r being what 1 is with f = u.x.
  const auto sites = generator("uniform").make(500, 3).sites;
  Random random(5);
  const Interpolator interpolator(delaunay(sites));
  for (int i = 0; i < 50; ++i) {
    const Point u = random.direction();
    std::vector<double> field;
    for (const Point& p : sites) field.push_back(2 + 3 * p.x - p.y + 0.5 * p.z);
    for (const Point& p : sites) field.push_back(p.x * u.x + p.y * u.y + p.z * u.z);
    const auto values = interpolator.values(field, {&u, 1}, linear);
    EXPECT_NEAR(values[0], 2 + values[1] * (3 * u.x - u.y + 0.5 * u.z), 1e-13);
  }
}

}  // namespace
}  // namespace rondel::test
