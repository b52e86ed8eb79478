// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedInterpolator beside the face that exact orientations find, with weights by long double;
// and laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "rondel/constrained_interpolate.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/constrained/constrained_queries.h"

namespace rondel::test::of_constrained_interpolator {
namespace {

using Wide = std::array<long double, 3>;

Wide direction_of(const Point& p, const Point& center) {
  const Wide v = {static_cast<long double>(p.x) - center.x,
                  static_cast<long double>(p.y) - center.y,
                  static_cast<long double>(p.z) - center.z};
  const long double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

long double determinant(const Wide& a, const Wide& b, const Wide& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The weights of the corners of a face: where the ray of the target meets its plane.
Wide weights_in(const Triangulation& t, const Triple& face, const Point& target) {
  const Point& center = t.sphere().center;
  const Wide u = direction_of(target, center);
  Wide weights{};
  long double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] = determinant(u, direction_of(t.sites()[face[(i + 1) % 3]], center),
                             direction_of(t.sites()[face[(i + 2) % 3]], center));
    sum += weights[i];
  }
  for (long double& w : weights) w /= sum;
  return weights;
}

// Every weight is that of a corner of the face that has the target.
void expect_weights(const ConstrainedTriangulation& result, const std::vector<Point>& targets) {
  const Triangulation& t = result.triangulation;
  const Weights found =
      ConstrainedInterpolator(result).weights(targets, {.hashes = false}, {.threads = 2});
  ASSERT_EQ(found.num_rows(), targets.size());
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const Location where = expected_location(t, targets[k]);
    const auto size = found.offsets[k + 1] - found.offsets[k];
    ASSERT_EQ(size == 0, where.where == Where::outside) << "target " << k;
    if (size == 0) continue;
    const Triple& face = t.faces()[where.face];
    const Wide expected = weights_in(t, face, targets[k]);
    for (std::uint64_t e = found.offsets[k]; e < found.offsets[k + 1]; ++e) {
      const auto corner = std::ranges::find(face, found.columns[e]);
      ASSERT_NE(corner, face.end()) << "target " << k << " in face " << where.face;
      const auto weight = static_cast<double>(expected[std::size_t(corner - face.begin())]);
      EXPECT_NEAR(found.values[e], weight, 1e-9) << "target " << k;
    }
  }
}

TEST(constrained_interpolator, takes_the_corners_of_the_face_that_has_a_target) {
  Random random(21);
  for (const std::size_t n : {4U, 12U, 60U}) {
    for (const char* kind : {"uniform", "hemisphere"}) {
      SCOPED_TRACE(std::string(kind) + " " + std::to_string(n));
      const SiteSet set = generator(kind).make(n, n);
      const auto constraints = long_constraints(set, n, random);
      const auto result = constrained_delaunay(set.sites, constraints, {.sphere = set.sphere});
      if (result.triangulation.dimension() < 2) continue;
      ASSERT_NO_FATAL_FAILURE(expect_weights(result, queries_of(set, random)));
    }
  }
}

// A dam between two lakes: the sites of the other lake are nearer than those of the own one.
TEST(constrained_interpolator, mixes_no_values_across_a_constraint) {
  std::vector<Point> sites = {{1, -0.5, 0}, {1, 0.5, 0}, {-1, 0, 0}};
  std::vector<double> field = {0, 0, 0};
  for (int i = -4; i <= 4; ++i) {
    sites.push_back({1, 0.1 * i, 0.02});
    field.push_back(1);
    sites.push_back({1, 0.1 * i + 0.05, -0.3});
    field.push_back(-1);
  }
  sites.push_back({0, 0, 1});
  field.push_back(1);
  sites.push_back({0, 0, -1});
  field.push_back(-1);
  const std::vector<Ends> dam = {{0, 1}};
  const ConstrainedInterpolator with(constrained_delaunay(sites, dam));
  const Interpolator without(delaunay(sites));
  std::vector<Point> south;
  for (int i = -40; i <= 40; ++i) south.push_back({1, 0.01 * i, -0.01});
  const auto kept = with.values(field, south);
  const auto mixed = without.values(field, south, {.method = Method::linear});
  EXPECT_LT(std::ranges::max(kept), 0);
  EXPECT_GT(std::ranges::max(mixed), 0.2);
  const std::vector<Point> on_dam = {{1, -0.25, 0}, {1, 0.3, 0}};
  EXPECT_EQ(with.values(field, on_dam), (std::vector<double>{0, 0}));
}

TEST(constrained_interpolator, is_an_interpolator_where_all_faces_are_delaunay) {
  const SiteSet set = generator("uniform").make(2'000, 5);
  const std::vector<Point> targets = generator("uniform").make(5'000, 6).sites;
  const Triangulation t = delaunay(set.sites);
  std::vector<Ends> constraints;
  for (const Triple& face : t.faces().first(300)) constraints.push_back({face[0], face[1]});
  const ConstrainedInterpolator constrained(constrained_delaunay(set.sites, constraints));
  const Interpolator plain(t);
  std::vector<double> field;
  for (const Point& p : set.sites) field.push_back(p.x + 2 * p.y * p.z);
  for (const auto normalization : {Normalization::unity, Normalization::homogeneous}) {
    const InterpolationOptions options = {.method = Method::linear, .normalization = normalization};
    const Weights a = constrained.weights(targets, {.normalization = normalization});
    const Weights b = plain.weights(targets, options);
    EXPECT_EQ(a.offsets, b.offsets);
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.values, b.values);
    EXPECT_EQ(a.sites_hash, b.sites_hash);
    EXPECT_EQ(a.targets_hash, b.targets_hash);
    EXPECT_EQ(constrained.values(field, targets, {.normalization = normalization}),
              plain.values(field, targets, options));
  }
}

TEST(constrained_interpolator, depends_on_no_order_and_no_threads) {
  Random random(22);
  SiteSet set = generator("uniform").make(300, 8);
  auto constraints = long_constraints(set, 200, random);
  const std::vector<Point> targets = generator("uniform").make(5'000, 9).sites;
  std::vector<double> field;
  for (const Point& p : set.sites) field.push_back(p.x * p.y + p.z);
  const ConstrainedInterpolator first(constrained_delaunay(set.sites, constraints));
  const auto values = first.values(field, targets, {}, {.threads = 1});
  EXPECT_EQ(values, first.values(field, targets, {}, {.threads = 3}));
  EXPECT_EQ(std::ranges::count_if(values, [](double v) { return std::isnan(v); }), 0);
  const auto last = static_cast<Index>(set.sites.size() - 1);
  std::ranges::reverse(set.sites);
  std::ranges::reverse(field);
  std::ranges::reverse(constraints);
  for (Ends& ends : constraints) ends = {last - ends[1], last - ends[0]};
  EXPECT_EQ(
      values,
      ConstrainedInterpolator(constrained_delaunay(set.sites, constraints)).values(field, targets));
}

// Sites on one side of the sphere: long faces along constraints lead a search for the nearest site
// astray, which is why it does not use them.
TEST(constrained_interpolator, gives_targets_outside_what_is_asked_for) {
  Random random(23);
  const SiteSet set = generator("hemisphere").make(200, 3);
  const auto constraints = long_constraints(set, 150, random);
  const ConstrainedInterpolator constrained(
      constrained_delaunay(set.sites, constraints, {.sphere = set.sphere}));
  std::vector<Point> targets;
  for (int i = 0; i < 300; ++i) targets.push_back(set.sphere.center + random_direction(random));
  std::vector<double> field(set.sites.size());
  std::iota(field.begin(), field.end(), 0.0);
  const auto missing = constrained.values(field, targets);
  const auto nearest = constrained.values(field, targets, {.outside = Outside::nearest});
  const auto expected = Interpolator(delaunay(set.sites, {Model::projected, set.sphere}))
                            .values(field, targets, {.method = Method::nearest});
  std::size_t num_outside = 0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const bool is_outside = std::isnan(missing[k]);
    num_outside += is_outside ? 1 : 0;
    EXPECT_EQ(nearest[k], is_outside ? expected[k] : missing[k]);
  }
  EXPECT_GT(num_outside, 100U);
  const auto first = std::ranges::find_if(missing, [](double v) { return std::isnan(v); });
  EXPECT_EQ(
      thrown_index([&] { return constrained.values(field, targets, {.outside = Outside::error}); }),
      static_cast<std::size_t>(first - missing.begin()));
}

TEST(constrained_interpolator, has_values_below_dimension_2_and_in_shared_places) {
  const std::vector<Point> ring = {{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {1, 0, 0}};
  const std::vector<double> field = {1, 3, 5, 2};
  const ConstrainedInterpolator in_ring(constrained_delaunay(ring, std::vector<Ends>{{0, 1}}));
  const std::vector<Point> targets = {{1, 1, 0}, {2, 0, 0}, {0, 0, 1}};
  const auto values = in_ring.values(field, targets);
  EXPECT_NEAR(values[0], 2, 1e-15);
  EXPECT_EQ(values[1], 1);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_EQ(in_ring.values(field, targets, {.shared_place = SharedPlace::mean})[1], 1.5);
  EXPECT_EQ(thrown_index([&] {
              return in_ring.values(field, targets, {.shared_place = SharedPlace::error});
            }),
            3U);
  const ConstrainedInterpolator empty(constrained_delaunay(std::vector<Point>{}, {}));
  EXPECT_TRUE(std::isnan(empty.values({}, targets)[0]));
  EXPECT_EQ(thrown_index([&] { return empty.weights(targets, {.outside = Outside::error}); }), 0U);
}

TEST(constrained_interpolator, names_what_it_refuses) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  ConstrainedTriangulation result = constrained_delaunay(sites, std::vector<Ends>{{0, 1}});
  const ConstrainedInterpolator interpolator(result);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(thrown_index([&] {
              return interpolator.weights(std::vector<Point>{{1, 0, 0}, {0, nan, 0}});
            }),
            1U);
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return interpolator.values(std::vector<double>{1, 2, 3}, sites);
            }),
            "field has 3 values, which are no multiple of the 4 sites");
  result.sides.pop_back();
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return ConstrainedInterpolator(result); }),
            "there are sides for 3 faces, but there are 4 faces");
}

}  // namespace
}  // namespace rondel::test::of_constrained_interpolator
