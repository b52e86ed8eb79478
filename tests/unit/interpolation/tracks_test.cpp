// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that do not determine gradients: tracks, meridians, planes and a site off them. The errors of methods with gradients for
// smooth fields are compared with those of linear interpolation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using Function = std::function<double(const Point&)>;

const std::vector<Function>& smooth_functions() {
  static const std::vector<Function> functions = {
      [](const Point& p) { return p.x + 2 * p.y + 3 * p.z; },
      [](const Point& p) { return 1 + p.x * p.x - 2 * p.y * p.z + std::exp(p.z); }};
  return functions;
}

struct TrackSites {
  std::string name;
  std::vector<Point> sites;
};

// A track along a meridian from 60 S to 60 N, with sites beside it by a little.
std::vector<Point> track(std::size_t n, double jitter_deg, Random& random) {
  std::vector<Point> sites;
  for (std::size_t i = 0; i < n; ++i) {
    const double lat = -60 + 120 * static_cast<double>(i) / static_cast<double>(n - 1);
    sites.push_back(unit_vector(LonLat{-30 + jitter_deg * random.signed_unit(), lat}));
  }
  return sites;
}

std::vector<TrackSites> track_sites() {
  Random random(4);
  std::vector<TrackSites> sets;
  for (const double jitter : {0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1}) {
    TrackSites one{"track and a station, " + std::to_string(jitter), track(200, jitter, random)};
    one.sites.push_back(unit_vector(LonLat{60, 10}));
    sets.push_back(one);
    TrackSites parallel{"parallel and poles, " + std::to_string(jitter), {{0, 0, 1}, {0, 0, -1}}};
    for (int i = 0; i < 200; ++i) {
      parallel.sites.push_back(unit_vector(LonLat{1.8 * i, 40 + jitter * random.signed_unit()}));
    }
    sets.push_back(parallel);
  }
  TrackSites plane{"a plane and a site off it", {}};
  for (int i = 0; i < 200; ++i) {
    const double turn = std::numbers::pi * random.signed_unit();
    plane.sites.push_back({std::cos(turn), 0, std::sin(turn)});
  }
  plane.sites.push_back({0.3, 1e-4, 0.95});
  sets.push_back(plane);
  return sets;
}

std::vector<Point> places_in_faces(const Triangulation& triangulation,
                                   std::span<const Point> sites) {
  Random random(5);
  std::vector<Point> places;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    if (triangulation.is_ghost(f)) continue;
    Point sum{};
    for (const Index v : triangulation.faces()[f]) {
      sum = sum + (0.01 + std::abs(random.signed_unit())) * sites[v];
    }
    places.push_back(normalized(sum));
  }
  return places;
}

// Their errors are at most so many times those of linear.
constexpr double max_overshoot = 2.5;

TEST(interpolation_tracks, methods_with_gradients_do_not_overshoot) {
  for (const TrackSites& set : track_sites()) {
    const Triangulation triangulation = delaunay(Sites::view(set.sites));
    const Interpolator interpolator(triangulation);
    const std::vector<Point> places = places_in_faces(triangulation, set.sites);
    for (const Function& function : smooth_functions()) {
      std::vector<double> field;
      for (const Point& p : set.sites) field.push_back(function(p));
      const auto error = [&](Method method) {
        const std::vector<double> found = interpolator.values(field, places, {.method = method});
        double most = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
          most = std::max(most, std::abs(found[i] - function(places[i])));
        }
        return most;
      };
      const double linear = error(Method::linear);
      ASSERT_GT(linear, 0.1) << set.name;
      EXPECT_LT(error(Method::hermite), max_overshoot * linear) << set.name;
      EXPECT_LT(error(Method::cubic), max_overshoot * linear) << set.name;
    }
  }
}

// Values of 1 and -1 at random on a grid whose first rows are 5 degrees off the poles, and short waves on a track with a hub.
TEST(interpolation_tracks, noise_stays_small) {
  Random random(8);
  std::vector<Point> grid;
  std::vector<double> signs;
  for (int lat = -85; lat < 90; lat += 10) {
    for (int lon = 0; lon < 360; lon += 5) {
      grid.push_back(unit_vector(LonLat{static_cast<double>(lon), static_cast<double>(lat)}));
      signs.push_back(random.signed_unit() < 0 ? -1 : 1);
    }
  }
  std::vector<Point> hub = track(200, 0.1, random);
  hub.push_back(unit_vector(LonLat{60, 10}));
  std::vector<double> waves;
  for (const Point& p : hub) waves.push_back(std::sin(50 * std::asin(p.z)));
  const auto largest = [](const std::vector<Point>& sites, const std::vector<double>& values,
                          Method method) {
    const Triangulation triangulation = delaunay(Sites::view(sites));
    const std::vector<Point> places = places_in_faces(triangulation, sites);
    double most = 0;
    for (const double found :
         Interpolator(triangulation).values(values, places, {.method = method})) {
      most = std::max(most, std::abs(found));
    }
    return most;
  };
  EXPECT_LT(largest(grid, signs, Method::hermite), 5);
  EXPECT_LT(largest(grid, signs, Method::cubic), 30);
  EXPECT_LT(largest(hub, waves, Method::hermite), 15);
  EXPECT_LT(largest(hub, waves, Method::cubic), 50);
}

// Exactly along a meridian the gradient is that of the field along it, and 0 across.
TEST(interpolation_tracks, gradient_across_is_zero_or_missing) {
  std::vector<Point> sites;
  for (int i = 0; i <= 40; ++i) sites.push_back(unit_vector(LonLat{0, -40.0 + 2 * i}));
  // This site is so near to the line of the others that it determines nothing across.
  sites.push_back(unit_vector(LonLat{1e-9, 0.5}));
  const Triangulation triangulation = delaunay(Sites::view(sites));
  const Interpolator interpolator(triangulation);
  std::vector<double> field;
  for (const Point& p : sites) field.push_back(5 * p.y + p.z);
  const Weights zero = interpolator.gradient();
  const Weights missing = interpolator.gradient({.undetermined = Undetermined::missing});
  std::vector<double> gradient(3 * sites.size());
  apply(zero, field, gradient, 1);
  for (std::size_t i = 5; i < 35; ++i) {
    const Point& p = sites[i];
    EXPECT_NEAR(gradient[3 * i + 1], 0, 1e-5) << i;
    EXPECT_NEAR(gradient[3 * i] * -p.z + gradient[3 * i + 2] * p.x, p.x, 0.05) << i;
    EXPECT_EQ(missing.offsets[3 * i], missing.offsets[3 * i + 3]) << i;
  }
}

TEST(interpolation_tracks, sums_that_leave_the_numbers_come_back) {
  Random random(7);
  std::vector<Point> sites;
  for (int i = 0; i < 200; ++i) sites.push_back(random.direction());
  const Interpolator interpolator(delaunay(Sites::view(sites)));
  std::vector<Point> targets;
  for (int i = 0; i < 2000; ++i) targets.push_back(random.direction());
  for (const double constant : {1.7e308, -1.7e308}) {
    const std::vector<double> field(sites.size(), constant);
    for (const Method method : {Method::linear, Method::sibson, Method::hermite, Method::cubic}) {
      for (const double value : interpolator.values(field, targets, {.method = method})) {
        EXPECT_EQ(value, constant);
      }
    }
  }
}

TEST(interpolation_tracks, homogeneous_normalization_is_refused_where_no_factor_does_it) {
  Random random(6);
  std::vector<Point> sites;
  for (int i = 0; i < 50; ++i) sites.push_back(random.direction());
  const Interpolator interpolator(delaunay(Sites::view(sites)));
  const std::vector<Point> targets = {{1, 0, 0}};
  const std::vector<double> field(sites.size(), 1.0);
  for (const Method method : {Method::hermite, Method::cubic}) {
    const InterpolationOptions options{.method = method,
                                       .normalization = Normalization::homogeneous};
    EXPECT_THROW((void)interpolator.weights(targets, options), InvalidInput);
    EXPECT_THROW((void)interpolator.values(field, targets, options), InvalidInput);
    EXPECT_NO_THROW((void)interpolator.vectors(sites, targets, options));
  }
}

}  // namespace
}  // namespace rondel::test
