// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// These rules hold for all methods: at sites, outside, in any order, with any threads, under
// rotations.

#include "unit/interpolation/rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "rondel/query.h"

namespace rondel::test {
namespace {

TEST(interpolation_rules, values_are_what_weights_apply_to) {
  for_each_interpolation_case(24, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    const std::size_t n = c.set.sites.size();
    const auto field = some_field(3 * n);
    for (const Method method : methods) {
      for (const Outside outside : {Outside::missing, Outside::nearest}) {
        for (const Normalization to : {Normalization::unity, Normalization::homogeneous}) {
          if (has_slopes(method) && to == Normalization::homogeneous) continue;
          const InterpolationOptions options = {
              .method = method, .outside = outside, .normalization = to};
          const Weights weights = interpolator.weights(c.targets, options);
          std::vector<double> applied(3 * c.targets.size());
          apply(weights, field, applied, n == 0 ? 1 : 3);
          if (n == 0) applied.resize(c.targets.size());
          const auto values = interpolator.values(field, c.targets, options);
          const bool agree =
              has_slopes(method) ? are_close(values, applied, weights) : are_same(values, applied);
          EXPECT_TRUE(agree) << c.name << " " << name_of(method);
        }
      }
    }
  });
}

// Rounding puts these targets beside sites, with weights of some 1e-17 of their neighbors.
TEST(interpolation_rules, what_rounding_leaves_of_a_missing_site_is_not_missing) {
  Random random(11);
  std::vector<Point> sites(200);
  for (Point& site : sites) site = random.in_ball();
  const Triangulation triangulation = delaunay(sites);
  std::vector<Point> targets;
  for (const Point& site : sites) targets.push_back({1.1 * site.x, 1.1 * site.y, 1.1 * site.z});
  std::vector<double> field = some_field(sites.size());
  for (std::size_t i = 0; i < field.size(); i += 3) field[i] = nan;
  const Interpolator interpolator(triangulation);
  std::size_t num_left = 0;  // values in spite of a missing site
  for (const Method method : {Method::linear, Method::laplace, Method::sibson}) {
    const Weights weights = interpolator.weights(targets, {.method = method});
    std::vector<double> applied(targets.size());
    apply(weights, field, applied);
    EXPECT_TRUE(are_same(interpolator.values(field, targets, {.method = method}), applied));
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const auto is_missing = [&](Index site) { return std::isnan(field[site]); };
      if (!std::isnan(applied[t])) {
        num_left +=
            static_cast<std::size_t>(std::ranges::count_if(row_of(weights, t).columns, is_missing));
      }
    }
  }
  EXPECT_GT(num_left, 0);
}

TEST(interpolation_rules, at_a_site_there_is_its_value_alone) {
  for_each_interpolation_case(24, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    for (const Method method : methods) {
      const Weights weights = interpolator.weights(c.set.sites, {.method = method});
      std::vector<Index> names(c.set.sites.size());
      std::iota(names.begin(), names.end(), Index{0});
      for (const Duplicate& d : c.triangulation.duplicates()) names[d.site] = d.representative;
      EXPECT_EQ(weights.columns, names) << c.name;
      EXPECT_EQ(weights.values, std::vector<double>(names.size(), 1.0)) << c.name;
    }
  });
}

TEST(interpolation_rules, the_order_of_sites_changes_no_byte) {
  for_each_interpolation_case(30, [](const InterpolationCase& c) {
    const std::size_t n = c.set.sites.size();
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), Index{0});
    // Those that share a place keep their order.
    if (!c.triangulation.duplicates().empty()) return;
    Random random(8);
    random.shuffle(order);
    std::vector<Point> shuffled;
    std::vector<double> shuffled_field;
    const auto field = some_field(n);
    for (const Index i : order) {
      shuffled.push_back(c.set.sites[i]);
      shuffled_field.push_back(field[i]);
    }
    const Interpolator one(c.triangulation);
    const Interpolator other(delaunay(shuffled, {.sphere = c.set.sphere}));
    for (const Method method : methods) {
      const InterpolationOptions options = {.method = method, .outside = Outside::nearest};
      EXPECT_TRUE(are_same(one.values(field, c.targets, options),
                           other.values(shuffled_field, c.targets, options)))
          << c.name << " " << name_of(method);
      const Weights given = one.weights(c.targets, options);
      Weights found = other.weights(c.targets, options);
      for (Index& column : found.columns) column = order[column];
      EXPECT_EQ(found.offsets, given.offsets) << c.name;
      EXPECT_EQ(found.columns, given.columns) << c.name << " " << name_of(method);
      EXPECT_TRUE(are_same(found.values, given.values)) << c.name << " " << name_of(method);
    }
  });
}

// A rotation in doubles moves each site by a rounding error, and values by that over the spacing.
TEST(interpolation_rules, a_rotation_of_everything_changes_little) {
  const auto sites = generator("uniform").make(400, 6).sites;
  const auto targets = generator("uniform").make(400, 7).sites;
  Random random(5);
  const Point z = random.direction();
  const Point x = normalized(cross_product(z, random.direction()));
  const Point y = cross_product(z, x);
  const auto turned = [&](std::vector<Point> points) {
    for (Point& p : points) p = p.x * x + (p.y * y + p.z * z);
    return points;
  };
  const auto field = some_field(sites.size());
  const Interpolator one(delaunay(sites));
  const Interpolator other(delaunay(turned(sites)));
  for (const Method method : methods) {
    const auto values = one.values(field, targets, {.method = method});
    const auto others = other.values(field, turned(targets), {.method = method});
    for (std::size_t t = 0; t < targets.size(); ++t) EXPECT_NEAR(values[t], others[t], 1e-11);
  }
}

TEST(interpolation_rules, threads_change_no_byte) {
  const auto sites = generator("clustered").make(2000, 1).sites;
  const auto targets = generator("uniform").make(is_shortened() ? 4500 : 9000, 2).sites;
  const Interpolator interpolator(delaunay(sites));
  const auto field = some_field(sites.size());
  for (const Method method : methods) {
    const InterpolationOptions options = {.method = method};
    EXPECT_EQ(interpolator.weights(targets, options, {.threads = 1}),
              interpolator.weights(targets, options, {.threads = 4}));
    EXPECT_TRUE(are_same(interpolator.values(field, targets, options, {.threads = 1}),
                         interpolator.values(field, targets, options, {.threads = 4})));
  }
}

TEST(interpolation_rules, outside_is_where_no_solid_face_is) {
  for_each_interpolation_case(30, [](const InterpolationCase& c) {
    const Interpolator interpolator(c.triangulation);
    const Locator locator(c.triangulation);
    const auto locations = locator.locate(c.targets);
    const Weights missing = interpolator.weights(c.targets, {.method = Method::linear});
    const Weights nearest =
        interpolator.weights(c.targets, {.method = Method::linear, .outside = Outside::nearest});
    std::size_t first = c.targets.size();
    for (std::size_t t = c.targets.size(); t-- > 0;) {
      const bool is_outside = locations[t].where == Where::outside;
      if (is_outside) first = t;
      EXPECT_EQ(row_of(missing, t).values.empty(), is_outside) << c.name;
      if (!is_outside || c.set.sites.empty()) continue;
      const WeightRow row = row_of(nearest, t);
      ASSERT_EQ(row.values.size(), 1U);
      EXPECT_EQ(row.values[0], 1);
      const double distance = locator.distance(c.targets[t], row.columns[0]);
      EXPECT_EQ(distance, locator.distance(c.targets[t], locator.nearest(c.targets[t])));
    }
    const auto strict = [&] {
      static_cast<void>(
          interpolator.weights(c.targets, {.method = Method::linear, .outside = Outside::error}));
    };
    if (first == c.targets.size()) return strict();
    try {
      strict();
      FAIL() << c.name;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.index(), first) << c.name;
      EXPECT_EQ(std::string(error.what()),
                "target " + std::to_string(first) + " is outside of the sites' faces");
    }
  });
}

}  // namespace
}  // namespace rondel::test
