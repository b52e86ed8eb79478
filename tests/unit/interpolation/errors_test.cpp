// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values that are missing, what is refused, and how long work is watched and stopped.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/graphs.h"
#include "rondel/io.h"
#include "rondel/names.h"
#include "rondel/polygon_files.h"
#include "rondel/query.h"
#include "rondel/regrid.h"
#include "rondel/remap.h"
#include "rondel/triangulation.h"
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
  expect_refused(3, "field has 3 values, which are no multiple of the 4 sites",
                 [&] { ask(std::span(field).first(3), sites); });
  expect_refused(0, "field has 0 values, which are no multiple of the 4 sites",
                 [&] { ask({}, sites); });
  expect_refused(InvalidInput::no_index, "there is no such method",
                 [&] { ask(field, sites, {.method = static_cast<Method>(17)}); });
  expect_refused(1, "field has 1 values, which are no multiple of the 0 sites", [&] {
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

// The names of enumerations, as help texts, files and Python have them.

template <class Value>
void expect_names(const std::vector<std::string_view>& names) {
  EXPECT_EQ(names_of<Value>(), names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_EQ(name_of(static_cast<Value>(k)), names[k]);
    EXPECT_EQ(from_name<Value>(names[k]), static_cast<Value>(k));
  }
  for (const int number : {static_cast<int>(names.size()), 255}) {
    EXPECT_EQ(name_of(static_cast<Value>(number)), "");
  }
  for (const std::string_view other : {"", "Linear", "no name"}) {
    EXPECT_FALSE(from_name<Value>(other).has_value());
  }
}

TEST(names, are_those_of_the_enumerators) {
  EXPECT_EQ(from_name<Method>("sibson"), Method::sibson);
  EXPECT_EQ(from_name<GraphKind>("mst"), GraphKind::spanning_tree);
  EXPECT_EQ(from_name<PolygonOverlap>("error"), PolygonOverlap::error);
  EXPECT_EQ(from_name<CellOverlap>("error"), CellOverlap::error);
  EXPECT_EQ(name_of(RemapNorm::fracarea), "fracarea");
  EXPECT_EQ(name_of(GridSides::great_circles), "great_circles");
  EXPECT_EQ(name_of(PolygonEdges::geodesic), "geodesic");
  EXPECT_EQ(name_of(Model::weighted), "weighted");
  EXPECT_EQ(name_of(Where::outside), "outside");
}

TEST(names, lead_back_to_their_values) {
  expect_names<Method>({"nearest", "linear", "laplace", "sibson", "hermite", "cubic"});
  expect_names<RegridMethod>({"bilinear", "nearest_d2s", "native"});
  expect_names<Outside>({"nan", "nearest", "error"});
  expect_names<SharedPlace>({"first", "mean", "error"});
  expect_names<Normalization>({"unity", "homogeneous"});
  expect_names<Undetermined>({"zero", "missing"});
  expect_names<GraphKind>({"delaunay", "urquhart", "gabriel", "relative", "mst"});
  expect_names<GridSides>({"parallels", "great_circles"});
  expect_names<PolygonEdges>({"lonlat", "geodesic"});
  expect_names<PolygonOverlap>({"keep", "error", "first"});
  expect_names<InvalidPolygons>({"error", "repair"});
  expect_names<NetcdfKind>({"by_name", "cdf2", "cdf5", "nc4"});
  expect_names<RemapNorm>({"destarea", "fracarea"});
  expect_names<CellOverlap>({"error", "first", "share", "each"});
  expect_names<Model>({"projected", "weighted"});
  expect_names<Where>({"vertex", "edge", "face", "outside"});
}

}  // namespace
}  // namespace rondel::test
