// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Places that several sites share, low dimensions, vectors and gradients.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "unit/interpolation/rules.h"

namespace rondel::test {
namespace {

TEST(interpolation_places, of_sites_in_one_place_the_first_or_the_mean_counts) {
  const Interpolator interpolator(delaunay(shared));
  const std::vector<double> field = {1, 10, 2, 100, 1000, 6};
  const std::vector<Point> targets = {{5, 0, 0}, {1, 1, 1}};
  for (const Method method : {Method::nearest, Method::linear}) {
    const auto first = interpolator.values(field, targets, {.method = method});
    EXPECT_EQ(first[0], 1);
    const InterpolationOptions mean = {.method = method, .shared_place = SharedPlace::mean};
    const auto means = interpolator.values(field, targets, mean);
    EXPECT_EQ(means[0], 3);
    const Weights weights = interpolator.weights(targets, mean);
    const WeightRow row = row_of(weights, 0);
    EXPECT_TRUE(std::ranges::equal(row.columns, std::array<Index, 3>{0, 2, 5}));
    for (const double w : row.values) EXPECT_EQ(w, 1.0 / 3);
    std::vector<double> applied(2);
    apply(weights, field, applied);
    EXPECT_NEAR(applied[0], 3, 1e-15);
    EXPECT_NEAR(applied[1], means[1], 1e-13);
  }
  EXPECT_NEAR(interpolator.values(field, targets, {.method = Method::linear})[1], 37, 1e-13);
}

TEST(interpolation_places, of_sites_in_one_place_the_first_duplicate_is_an_error_if_asked_for) {
  const Interpolator interpolator(delaunay(shared));
  expect_refused(2, "site 2 is in the place of site 0", [&] {
    static_cast<void>(interpolator.weights(
        shared, {.method = Method::nearest, .shared_place = SharedPlace::error}));
  });
}

// --- low dimensions ---

TEST(interpolation_places, without_sites_there_are_no_values) {
  const Interpolator interpolator{Triangulation()};
  const std::vector<Point> targets = {{1, 0, 0}, {0, 1, 0}};
  for (const Method method : methods) {
    const auto values =
        interpolator.values({}, targets, {.method = method, .outside = Outside::nearest});
    ASSERT_EQ(values.size(), 2U);
    EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[1]));
    const Weights weights = interpolator.weights(targets, {.method = method});
    EXPECT_EQ(weights.offsets, std::vector<std::uint64_t>({0, 0, 0}));
  }
  expect_refused(0, "target 0 is outside of the sites' faces", [&] {
    static_cast<void>(
        interpolator.values({}, targets, {.method = Method::linear, .outside = Outside::error}));
  });
}

TEST(interpolation_places, one_site_is_known_at_itself_and_as_the_nearest) {
  const Interpolator interpolator(delaunay(std::vector<Point>{{0, 0, 2}}));
  const std::vector<Point> targets = {{0, 0, 1}, {0, 1, 1}};
  for (const Method method : {Method::linear, Method::sibson, Method::cubic}) {
    const auto values = interpolator.values(std::array{5.0}, targets, {.method = method});
    EXPECT_EQ(values[0], 5);
    EXPECT_TRUE(std::isnan(values[1]));
  }
  EXPECT_EQ(interpolator.values(std::array{5.0}, targets, {.method = Method::nearest}),
            std::vector<double>({5, 5}));
}

TEST(interpolation_places, on_a_circle_values_are_linear_within_solid_arcs) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {0, 1, 2};
  const std::vector<Point> targets = {{1, 1, 0}, {2, 1, 0}, {0, -1, 0}, {1, 1, 1e-9}};
  for (const Method method : {Method::linear, Method::laplace, Method::hermite}) {
    const auto values = interpolator.values(field, targets, {.method = method});
    EXPECT_NEAR(values[0], 0.5, 1e-15);
    EXPECT_NEAR(values[1], 1.0 / 3, 1e-15);  // of the chord, where x : y = 2 : 1
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_TRUE(std::isnan(values[3]));
  }
}

// --- vectors ---

TEST(interpolation_places, rotations_come_back_across_the_poles) {
  Random random(9);
  for (const char* const kind : {"uniform", "globe_grid", "hemisphere", "patch_1e_6"}) {
    const SiteSet set = generator(kind).make(300, 2);
    const Point axis = 10 * random.direction();
    std::vector<Point> field;
    std::vector<double> coordinates(3 * set.sites.size());
    for (std::size_t i = 0; i < set.sites.size(); ++i) {
      const Point x = normalized(set.sites[i]);
      field.push_back(cross_product(axis, x));
      coordinates[i] = x.x;
      coordinates[set.sites.size() + i] = x.y;
      coordinates[2 * set.sites.size() + i] = x.z;
    }
    const Interpolator interpolator(delaunay(set.sites));
    std::vector<Point> targets = {{0, 0, 1}, {0, 0, -1}, {1e-9, 0, 1}, {1, 2, -1e9}};
    for (int i = 0; i < 200; ++i) {
      targets.push_back(random_near(random, set.sites[random.below(set.sites.size())], 1e-7));
    }
    for (const Method method : {Method::linear, Method::laplace, Method::sibson}) {
      const InterpolationOptions options = {.method = method,
                                            .normalization = Normalization::homogeneous};
      const auto found = interpolator.vectors(field, targets, options);
      const auto xyz = interpolator.values(coordinates, targets, options);
      for (std::size_t t = 0; t < targets.size(); ++t) {
        if (std::isnan(found[t].x)) continue;
        const Point u = normalized(targets[t]);
        const Point off = found[t] - cross_product(axis, u);
        EXPECT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 2e-14) << kind;
        EXPECT_NEAR(xyz[t], u.x, 1e-15) << kind;
        EXPECT_NEAR(xyz[targets.size() + t], u.y, 1e-15) << kind;
        EXPECT_NEAR(xyz[2 * targets.size() + t], u.z, 1e-15) << kind;
      }
    }
  }
}

TEST(interpolation_places, vectors_are_tangent_and_several_at_once) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(50, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  Random random(1);
  std::vector<Point> field;
  for (int i = 0; i < 200; ++i) field.push_back(random.direction());
  for (const Method method : methods) {
    const auto both = interpolator.vectors(field, targets, {.method = method});
    const auto second =
        interpolator.vectors(std::span(field).subspan(100), targets, {.method = method});
    ASSERT_EQ(both.size(), 100U);
    EXPECT_TRUE(std::ranges::equal(std::span(both).subspan(50), second));
    for (std::size_t t = 0; t < 50; ++t) {
      const Point& u = targets[t];
      EXPECT_NEAR(both[t].x * u.x + both[t].y * u.y + both[t].z * u.z, 0, 1e-15);
    }
  }
}

// A mean is a number where the sum of the values is none.
TEST(interpolation_places, means_of_the_largest_numbers_are_numbers) {
  const Interpolator interpolator(delaunay(shared));
  const double largest = std::numeric_limits<double>::max();
  const std::vector<double> field(shared.size(), largest);
  const std::vector<double> lowest(shared.size(), -largest);
  const InterpolationOptions mean = {.method = Method::nearest, .shared_place = SharedPlace::mean};
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const std::vector<Point> at = {shared[i]};
    EXPECT_NEAR(interpolator.values(field, at, mean).front() / largest, 1, 1e-15);
    EXPECT_NEAR(interpolator.values(lowest, at, mean).front() / largest, -1, 1e-15);
  }
}

// In one place the first site's gradient counts, or the mean; at a site none does.
TEST(interpolation_places, given_gradients_follow_the_rules_of_values) {
  const Interpolator interpolator(delaunay(shared));
  const std::vector<double> field = {0, 0, 0, 0, 0, 0};
  const Point g = {0, 1, 1};
  const std::vector<Point> first = {g, {}, {nan, 0, 0}, {}, {}, {nan, 0, 0}};
  const std::vector<Point> thirds = {3 * g, {}, {}, {}, {}, {}};
  const std::vector<Point> targets = {{3, 1, 1}, {1, 0, 0}};
  for (const Method method : {Method::hermite, Method::cubic}) {
    const auto values = interpolator.values(field, first, targets, {.method = method});
    const auto means = interpolator.values(field, thirds, targets,
                                           {.method = method, .shared_place = SharedPlace::mean});
    EXPECT_GT(values[0], 0.1);
    EXPECT_EQ(values[1], 0);
    EXPECT_TRUE(are_same(values, means));
  }
}

TEST(interpolation_places, gradients_of_a_field_are_its_rows) {
  const auto sites = generator("exact_duplicates").make(60, 2).sites;
  const Triangulation triangulation = delaunay(sites);
  const Interpolator interpolator(triangulation);
  const Weights gradient = interpolator.gradient();
  ASSERT_EQ(gradient.num_rows(), 3 * sites.size());
  EXPECT_EQ(gradient.num_columns, sites.size());
  EXPECT_EQ(gradient.sites_hash, point_set_hash(sites));
  for (const Duplicate& d : triangulation.duplicates()) {
    const std::size_t own = d.site;
    const std::size_t first = d.representative;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::ranges::equal(row_of(gradient, 3 * own + c).values,
                                     row_of(gradient, 3 * first + c).values));
    }
  }
  const Weights none = Interpolator(delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}})).gradient();
  EXPECT_EQ(none.offsets, std::vector<std::uint64_t>(7, 0));
}

}  // namespace
}  // namespace rondel::test
