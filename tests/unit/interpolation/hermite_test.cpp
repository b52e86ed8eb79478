// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/hermite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "support/generators.h"
#include "unit/interpolation/slopes.h"

namespace rondel::test {
namespace {

using namespace interpolation;

TEST(interpolation_hermite, gives_linear_functions_of_space_back) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const SiteSet set = generator.make(200, 1);
    const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
    if (triangulation.dimension() < 2) continue;
    const PreparedTriangulation prepared(triangulation);
    Random random(2);
    const Point slope = random.direction();
    std::vector<double> values;
    std::vector<Point> gradients;
    for (Index v = 0; v < prepared.num_vertices(); ++v) {
      const Point x = unit_point(prepared, v);
      values.push_back(2 + dot(slope, x));
      gradients.push_back(slope - dot(slope, x) * x);
    }
    HermiteKernel kernel(prepared);
    for (const LocatedTarget& place : places_in_faces(prepared, scaled(100), random)) {
      GradientRow row;
      kernel(place, row);
      ASSERT_NEAR(sum_of_weights(row), 1, 4 * 0x1p-52) << generator.name;
      const Point u = exact::to_point(exact::to_vector(place.unit.hi));
      ASSERT_NEAR(sum_of(row, values, gradients), 2 + dot(slope, u), 1e-13) << generator.name;
    }
  }
}

// Gradients of such values are beyond the largest number.
TEST(interpolation_hermite, values_up_to_the_largest_number_are_carried) {
  Random random(5);
  std::vector<Point> sites;
  std::vector<Point> targets;
  for (int i = 0; i < 60; ++i) sites.push_back(random.direction());
  for (int i = 0; i < 60; ++i) targets.push_back(random.direction());
  std::vector<double> values;
  for (const Point& site : sites) values.push_back(site.z);
  const Triangulation triangulation = delaunay(sites);
  const Interpolator interpolator(triangulation);
  for (const Method method : {Method::hermite, Method::cubic}) {
    const std::vector<double> expected = interpolator.values(values, targets, {.method = method});
    std::vector<double> large = values;
    for (double& value : large) value *= 0x1p1023;
    const std::vector<double> found = interpolator.values(large, targets, {.method = method});
    for (std::size_t i = 0; i < targets.size(); ++i) EXPECT_EQ(found[i], expected[i] * 0x1p1023);
  }
  for (double& value : values) value = value > 0 ? 1.7e308 : -1.7e308;
  EXPECT_THROW((void)interpolator.values(values, targets, {.method = Method::cubic}), InvalidInput);
}

TEST(interpolation_hermite, is_sibson_where_a_neighbor_has_no_gradient) {
  Random random(3);
  std::vector<Point> sites;
  for (int i = 0; i < 300; ++i) sites.push_back(random.direction());
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  std::vector<std::uint8_t> has_gradient(prepared.num_vertices());
  for (std::uint8_t& has : has_gradient) has = random.below(5) > 0 ? 1 : 0;
  HermiteKernel kernel(prepared, has_gradient);
  SibsonKernel sibson(prepared);
  int num_without = 0;
  for (const LocatedTarget& place : places_in_faces(prepared, 300, random)) {
    GradientRow row;
    Row flat;
    kernel(place, row);
    sibson(place, flat);
    if (std::ranges::all_of(flat,
                            [&](const WeightedVertex& s) { return has_gradient[s.vertex] != 0; })) {
      continue;
    }
    ++num_without;
    ASSERT_EQ(row.size(), flat.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
      ASSERT_EQ(row[k].vertex, flat[k].vertex);
      ASSERT_EQ(row[k].weight, flat[k].weight);
      ASSERT_EQ(row[k].slope, Point{});
    }
  }
  EXPECT_GT(num_without, 10);
}

}  // namespace
}  // namespace rondel::test
