// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Natural neighbors against their definition in numbers of 4400 bits, and what must hold of them.

#include "interpolation/natural.h"

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

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/interpolate.h"
#include "support/generators.h"
#include "support/natural_oracle.h"
#include "support/query_oracle.h"
#include "unit/interpolation/support.h"

namespace rondel {
namespace {

using interpolation::LocatedTarget;
using interpolation::NaturalKernel;
using interpolation::NaturalMethod;
using interpolation::PreparedTriangulation;
using interpolation::Row;

constexpr double weight_error = 1e-13;

// The place of a target, as interpolation finds it.
LocatedTarget place_of(const PreparedTriangulation& prepared, const Point& target) {
  query::Cursor cursor;
  cursor.vertex = prepared.near(target);
  return {target, exact::unit_vector(target, prepared.center()),
          prepared.engine().locate(target, cursor)};
}

bool is_for_kernels(const LocatedTarget& place) {
  return place.location.where == Where::face || place.location.where == Where::edge;
}

bool is_on_contour(const PreparedTriangulation& prepared, const LocatedTarget& place) {
  if (place.location.where != Where::edge) return false;
  const auto& [a, b, none] = place.location.sites;
  for (std::size_t f = 0; f < prepared.mesh().num_slots(); ++f) {
    const auto& corners = prepared.mesh()[static_cast<Index>(f)].vertex;
    if (std::ranges::count(corners, a) + std::ranges::count(corners, b) == 2 &&
        !prepared.is_solid(static_cast<Index>(f)))
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

// True where the row is that of an edge beside a flat face (flat_faces_test.cpp), which is not that
// of the definition.
bool is_beside_flat_face(const PreparedTriangulation& prepared, const LocatedTarget& place) {
  const auto& flat = prepared.flat_faces();
  if (flat.empty()) return false;
  if (flat.contains(place.location.face)) return true;
  if (flat.location_beside(place) != place.location) return true;
  const auto& behind = prepared.mesh()[place.location.face].opposite;
  return place.location.where == Where::edge &&
         std::ranges::any_of(behind, [&](Index h) { return flat.contains(topology::face_of(h)); });
}

void compare(const PreparedTriangulation& prepared, const test::NaturalOracle& oracle,
             const Point& target, Difference& difference) {
  const LocatedTarget place = place_of(prepared, target);
  if (!is_for_kernels(place) || is_on_contour(prepared, place)) return;
  if (is_beside_flat_face(prepared, place)) return;
  const auto gnomonic = oracle.weights(target, test::NaturalPlane::gnomonic);
  const auto stereographic = oracle.weights(target, test::NaturalPlane::stereographic);
  ASSERT_FALSE(gnomonic.sibson.empty()) << "the cell reaches beyond the hemisphere";
  ASSERT_FALSE(stereographic.sibson.empty());
  const auto check = [&](NaturalMethod method, const std::vector<double>& expected) {
    Row row;
    NaturalKernel kernel(prepared, method);
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

// The definition takes the square of a ring's length, in long numbers: half a minute of 300.
bool has_long_ring(interpolation::NaturalRegion& region, const LocatedTarget& place) {
  if (!is_for_kernels(place)) return false;
  region.find(place);
  region.list_faces();
  return region.ring().size() > 150;
}

Difference compare_with_definition(const test::SiteSet& set, std::uint64_t seed, std::size_t step) {
  Difference difference;
  const auto triangulation = delaunay(set.sites, {.sphere = set.sphere});
  if (triangulation.dimension() < 2) return difference;
  // The definition takes the square of a ring's length, in long numbers.
  if (step > 1 && largest_degree(triangulation) > 40) step *= 6;
  const PreparedTriangulation prepared(triangulation);
  std::vector<Point> places;
  for (Index v = 0; v < prepared.num_vertices(); ++v) places.push_back(prepared.point(v));
  const test::NaturalOracle oracle(places, prepared.center());
  test::Random random(seed);
  const std::vector<Point> targets = targets_of(triangulation, set.sites, random);
  interpolation::NaturalRegion region(prepared);
  for (std::size_t i = 0; i < targets.size(); i += step) {
    if (step > 1 && has_long_ring(region, place_of(prepared, targets[i]))) continue;
    compare(prepared, oracle, targets[i], difference);
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

TEST(interpolation_natural, the_region_is_that_of_the_query) {
  for (const test::Generator& generator : test::generators()) {
    if (generator.weighted_only) continue;
    const test::SiteSet set = generator.make(60, 9);
    const auto triangulation = delaunay(set.sites, {.sphere = set.sphere});
    if (triangulation.dimension() < 2) continue;
    const PreparedTriangulation prepared(triangulation);
    interpolation::NaturalRegion region(prepared);
    test::Random random(5);
    for (const Point& target : test::query_points(set.sites, set.sphere.center, random)) {
      const LocatedTarget place = place_of(prepared, target);
      if (!is_for_kernels(place)) continue;
      region.find(place);
      region.list_faces();
      query::Cursor cursor;
      cursor.vertex = prepared.near(target);
      const auto faces = prepared.engine().conflict_region(target, cursor);
      ASSERT_EQ(region.faces().size(), faces.size());
      ASSERT_EQ(region.ring().size(), faces.size() + 2);
      EXPECT_EQ(region.ring().front(), std::ranges::min(region.ring()));
      std::set<Index> around(region.ring().begin(), region.ring().end());
      std::set<std::set<Index>> expected;
      std::set<std::set<Index>> found;
      for (const Index f : faces) {
        EXPECT_TRUE(prepared.is_solid(f) || is_on_contour(prepared, place));
        const auto& corners = prepared.mesh()[f].vertex;
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
