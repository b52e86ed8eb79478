// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values that are missing, what is refused, and how long work is watched and stopped.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

#include "unit/interpolation/rules.h"

namespace rondel::test {
namespace {

TEST(interpolation_errors, a_missing_value_is_missed_where_it_counts) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {nan, 1, 2, 3};
  const auto values = interpolator.values(
      field, std::vector<Point>{{1, 1, 1}, {0, 1, 1}, {0, 1, 0}}, {.method = Method::linear});
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_NEAR(values[1], 1.5, 1e-15);
  EXPECT_EQ(values[2], 1);
}

TEST(interpolation_errors, what_breaks_the_contract_is_refused) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {0, 1, 2, 3};
  const std::vector<Point> bad = {{1, 0, 0}, {nan, 0, 0}};
  const std::vector<Point> center = {{1, 0, 0}, {1, 2, 3}, {0, 0, 0}};
  const auto ask = [&](std::span<const double> f, std::span<const Point> targets,
                       const InterpolationOptions& options = {.method = Method::linear}) {
    static_cast<void>(interpolator.values(f, targets, options));
  };
  expect_refused(1, "target 1: (nan, 0, 0) is not finite", [&] { ask(field, bad); });
  expect_refused(2, "target 2: (0, 0, 0) is the center of the sphere and has no direction",
                 [&] { ask(field, center); });
  expect_refused(3, "field has 3 values, which are no fields of 4 sites",
                 [&] { ask(std::span(field).first(3), sites); });
  expect_refused(0, "field has 0 values, which are no fields of 4 sites", [&] { ask({}, sites); });
  expect_refused(InvalidInput::no_index, "there is no such method",
                 [&] { ask(field, sites, {.method = static_cast<Method>(17)}); });
  expect_refused(1, "field has 1 values, which are no fields of 0 sites", [&] {
    static_cast<void>(Interpolator(Triangulation()).values(std::array{1.0}, sites));
  });
}

TEST(interpolation_errors, gradients_are_as_many_as_values_and_for_who_takes_them) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Interpolator interpolator(delaunay(sites));
  const std::vector<double> field = {0, 1, 2, 3};
  expect_refused(3, "there are 3 gradients for 4 values", [&] {
    static_cast<void>(
        interpolator.values(field, std::span(sites).first(3), sites, {.method = Method::cubic}));
  });
  expect_refused(InvalidInput::no_index, "only hermite and cubic take gradients", [&] {
    static_cast<void>(interpolator.values(field, sites, sites, {.method = Method::linear}));
  });
  const Interpolator weighted(delaunay(sites, {.model = Model::weighted}));
  expect_refused(InvalidInput::no_index, "weighted sites have no gradients",
                 [&] { static_cast<void>(weighted.gradient()); });
}

TEST(interpolation_errors, weighted_sites_have_the_nearest_by_power_distance) {
  const std::vector<Point> sites = {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const Triangulation triangulation = delaunay(sites, {.model = Model::weighted});
  const Interpolator interpolator(triangulation);
  const std::vector<double> field = {0, 1, 2, 3};
  const std::vector<Point> targets = {{1, 1.5, 0}, {1, 2.5, 0}};
  EXPECT_EQ(interpolator.values(field, targets, {.method = Method::nearest}),
            std::vector<double>({0, 1}));
  expect_refused(InvalidInput::no_index, "weighted sites have no method but nearest", [&] {
    static_cast<void>(interpolator.weights(targets, {.method = Method::linear}));
  });
}

TEST(interpolation_errors, hashes_are_those_of_sites_and_targets_or_none) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(50, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  const Weights with = interpolator.weights(targets, {.method = Method::nearest});
  EXPECT_EQ(with.sites_hash, point_set_hash(sites));
  EXPECT_EQ(with.targets_hash, point_set_hash(targets));
  const Weights without =
      interpolator.weights(targets, {.method = Method::nearest, .hashes = false});
  EXPECT_EQ(without.sites_hash, 0U);
  EXPECT_EQ(without.targets_hash, 0U);
}

TEST(interpolation_errors, progress_is_told_and_a_flag_obeyed) {
  const auto sites = generator("uniform").make(100, 2).sites;
  const auto targets = generator("uniform").make(20000, 3).sites;
  const Interpolator interpolator(delaunay(sites));
  std::vector<double> fractions;
  const Progress progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "interpolate");
    fractions.push_back(fraction);
  };
  static_cast<void>(interpolator.weights(targets, {.method = Method::linear},
                                         {.threads = 1, .progress = progress}));
  EXPECT_EQ(fractions.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(
      static_cast<void>(interpolator.weights(targets, {.method = Method::linear}, {.stop = &stop})),
      Interrupted);
}

}  // namespace
}  // namespace rondel::test
