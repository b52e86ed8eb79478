// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites on the border that are on one great circle up to rounding: values beside them are those of
// the sites next to them, by every method. The oracle is a function whose slope is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/constrained_interpolate.h"
#include "rondel/query.h"
#include "unit/interpolation/rules.h"

namespace rondel::test {
namespace {

constexpr std::array many_methods = {Method::linear, Method::laplace, Method::sibson,
                                     Method::hermite, Method::cubic};

// Rows of sites on circles around one axis, which is turned at random. The first row is on a great
// circle, and all others on one side of it.
struct TurnedRows {
  std::vector<double> angles;  // along the row, ascending, radians
  std::vector<Point> sites;
  std::array<Point, 3> axes;

  // Returns the place at such longitude and latitude, each coordinate off by some ulps.
  Point at(double lon, double lat, Random& random, int most_ulps) const {
    const double a = std::cos(lat) * std::cos(lon);
    const double b = std::cos(lat) * std::sin(lon);
    const double c = std::sin(lat);
    const auto off = [&] {
      const auto range = static_cast<std::uint64_t>(2 * most_ulps + 1);
      return 0x1p-53 * (static_cast<double>(random.below(range)) - most_ulps);
    };
    const auto& [x, y, z] = axes;
    return {a * x.x + b * y.x + c * z.x + off(), a * x.y + b * y.y + c * z.y + off(),
            a * x.z + b * y.z + c * z.z + off()};
  }
};

TurnedRows turned_rows(Random& random, std::size_t length, std::size_t num_rows) {
  TurnedRows rows;
  const Point x = random.direction();
  const Point other = random.direction();
  const Point z = normalized(Point{x.y * other.z - x.z * other.y, x.z * other.x - x.x * other.z,
                                   x.x * other.y - x.y * other.x});
  rows.axes = {x, {z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x}, z};
  const double step = (0.05 + 1.45 * std::abs(random.signed_unit())) / static_cast<double>(length);
  for (std::size_t i = 0; i < length; ++i) {
    rows.angles.push_back(step * (static_cast<double>(i) + 0.4 * random.signed_unit()));
  }
  for (std::size_t row = 0; row < num_rows; ++row) {
    for (const double angle : rows.angles) {
      rows.sites.push_back(rows.at(angle, step * static_cast<double>(row), random, 1));
    }
  }
  return rows;
}

// A function on the sphere whose slope is at most 3.
double wave(const Point& p) { return std::sin(2 * p.x + 2 * p.y - p.z); }
std::vector<double> waves(const std::vector<Point>& places) {
  std::vector<double> values;
  for (const Point& p : places) values.push_back(wave(p));
  return values;
}

TEST(interpolation_flat_faces, values_beside_a_row_are_those_of_its_next_sites) {
  std::size_t num_inside = 0;
  for (std::uint64_t seed = 0; seed < scaled(60); ++seed) {
    Random random(seed);
    const std::size_t length = 3 + random.below(30);
    const TurnedRows rows = turned_rows(random, length, 1 + random.below(5));
    const Interpolator interpolator(delaunay(rows.sites));
    std::vector<Point> targets;
    std::vector<double> bounds;
    for (std::size_t i = 0; i + 1 < length; ++i) {
      const double gap = rows.angles[i + 1] - rows.angles[i];
      for (const double share : {0.0, 0.3, 0.5, 0.9}) {
        targets.push_back(rows.at(rows.angles[i] + share * gap, 0, random, 2));
        bounds.push_back(share == 0 ? 1e-12 : 3 * gap);
      }
    }
    for (const Method method : many_methods) {
      const auto values =
          interpolator.values(waves(rows.sites), targets, {.method = method, .hashes = false});
      for (std::size_t t = 0; t < targets.size(); ++t) {
        if (std::isnan(values[t])) continue;
        ++num_inside;
        ASSERT_LE(std::abs(values[t] - wave(targets[t])), bounds[t])
            << seed << ' ' << name_of(method) << " target " << t;
      }
    }
  }
  EXPECT_GT(num_inside, scaled(60) * 5);
}

TEST(interpolation_flat_faces, rows_keep_the_rules) {
  for (std::uint64_t seed = 0; seed < scaled(30); ++seed) {
    Random random(100 + seed);
    TurnedRows rows = turned_rows(random, 4 + random.below(20), 1 + random.below(4));
    std::vector<Point> targets;
    for (int i = 0; i < 60; ++i) {
      const double along = std::abs(random.signed_unit()) * rows.angles.back();
      targets.push_back(rows.at(along, 0, random, 2));
    }
    const std::size_t n = rows.sites.size();
    SiteSet set{rows.sites};
    const Triangulation triangulation = delaunay(rows.sites);
    const std::vector<Location> locations = Locator(triangulation).locate(targets);
    std::ranges::reverse(rows.sites);
    const Interpolator turned(delaunay(rows.sites));
    for (const Method method : many_methods) {
      const InterpolationOptions options = {.method = method, .hashes = false};
      const Weights weights = Interpolator(triangulation).weights(targets, options, {.threads = 1});
      Weights others = turned.weights(targets, options, {.threads = 3});
      for (Index& column : others.columns) column = static_cast<Index>(n) - 1 - column;
      ASSERT_EQ(weights.columns, others.columns) << seed;
      ASSERT_EQ(weights.values, others.values) << seed;
      for (std::size_t t = 0; t < targets.size(); ++t) {
        const WeightRow row = row_of(weights, t);
        if (method == Method::linear) {
          ASSERT_EQ(row.values.empty(), locations[t].where == Where::outside) << seed;
        }
        if (row.values.empty()) continue;
        const WeightErrors errors = weight_errors(row, set, targets[t]);
        double absolute = 0;
        for (const double weight : row.values) absolute += std::abs(weight);
        ASSERT_LE(std::abs(errors.unity), 8 * ulp * absolute) << seed;
        if (has_slopes(method)) continue;
        ASSERT_LE(errors.direction, 1e-14) << seed;
        ASSERT_GE(*std::ranges::min_element(row.values), 0) << seed;
      }
    }
  }
}

TEST(interpolation_flat_faces, constrained_faces_have_the_same_rows) {
  for (std::uint64_t seed = 0; seed < scaled(20); ++seed) {
    Random random(200 + seed);
    const TurnedRows rows = turned_rows(random, 12, 3);
    std::vector<Point> targets;
    for (const double angle : rows.angles) targets.push_back(rows.at(angle, 0, random, 2));
    const auto result = constrained_delaunay(rows.sites, {});
    const Weights constrained = ConstrainedInterpolator(result).weights(targets);
    const Weights weights =
        Interpolator(result.triangulation).weights(targets, {.method = Method::linear});
    EXPECT_EQ(constrained, weights);
  }
}

// A face that is as flat, but has no row beside it, keeps its three weights away from the edges; so
// does a small one that is no flatter than others.
TEST(interpolation_flat_faces, other_faces_stay) {
  const std::vector<Point> narrow = {{1, 0, 0}, {1, 1e-3, 0}, {1, 5e-4, 1e-14}};
  const std::vector<Point> tiny = {{1, 0, 0}, {1, 1e-15, 0}, {1, 5e-16, 1e-15}};
  for (const std::vector<Point>& sites : {narrow, tiny}) {
    const Point middle = {3, sites[1].y + sites[2].y, sites[2].z};
    const Weights weights = Interpolator(delaunay(sites))
                                .weights({&middle, 1}, {.method = Method::linear, .hashes = false});
    ASSERT_EQ(weights.values.size(), 3U);
    for (const double weight : weights.values) EXPECT_NEAR(weight, 1.0 / 3, 1e-6);
  }
}

}  // namespace
}  // namespace rondel::test
