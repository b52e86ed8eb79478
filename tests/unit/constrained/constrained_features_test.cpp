// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites and constraints of features.
#include "rondel/constrained_features.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/generators.h"

namespace rondel::test::of_constrained_features {
namespace {

using Ends = std::array<Index, 2>;

const std::vector<Point> corners = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}};

// A point, a line that closes, nothing, and a polygon with a corner that occurs twice in a row.
struct Features {
  FeatureLines lines;
  CellRings polygons;

  Features() {
    lines.rows.append(std::span(corners).first(1));
    lines.end_group();
    lines.rows.append(std::array{corners[1], corners[2], corners[0], corners[1]});
    lines.end_group();
    lines.end_group();
    lines.end_group();
    polygons.points = corners;
    polygons.points.push_back({0.0, -0.0, 1});
    for (int i = 0; i < 3; ++i) polygons.end_cell();
    polygons.append_ring(std::array<Index, 4>{3, 2, 4, 1});
    polygons.end_cell();
  }
};

TEST(constrained_features, places_are_sites_once_and_sides_are_constraints) {
  const Features given;
  const FeatureConstraints made = constraints_of_features(given.lines, given.polygons);
  EXPECT_EQ(made.sites, (std::vector<Point>{corners[0], corners[1], corners[2], corners[3]}));
  EXPECT_EQ(made.constraints, (std::vector<Ends>{{1, 2}, {2, 0}, {0, 1}, {3, 2}, {2, 1}, {1, 3}}));
  EXPECT_EQ(made.features, (std::vector<Index>{1, 1, 1, 3, 3, 3}));
  EXPECT_EQ(made.polygons.offsets, (std::vector<std::uint64_t>{0, 0, 0, 0, 3}));
  EXPECT_EQ(made.polygons.values, (std::vector<Index>{3, 4, 5}));
}

TEST(constrained_features, nothing_has_no_constraints) {
  const FeatureConstraints made = constraints_of_features({}, {});
  EXPECT_TRUE(made.sites.empty());
  EXPECT_EQ(made.polygons.size(), 0U);
}

TEST(constrained_features, whole_spheres_and_arrays_that_do_not_fit_are_refused) {
  const auto refused = [](const Features& given) -> std::size_t {
    try {
      constraints_of_features(given.lines, given.polygons);
    } catch (const InvalidInput& error) {
      return error.index();
    }
    return 1000;
  };
  Features whole;
  whole.polygons.whole = {2};
  EXPECT_EQ(refused(whole), 2U);
  Features fewer;
  fewer.lines.end_group();
  EXPECT_EQ(refused(fewer), InvalidInput::no_index);
  Features wild;
  wild.polygons.corners.back() = 9;
  EXPECT_EQ(refused(wild), InvalidInput::no_index);
  Features infinite;
  infinite.lines.rows.values.back().x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(infinite), 1U);
}

// Numbers of a file, with few decimals, come back; others give a position next to that of lonlats().
TEST(constrained_features, short_degrees_are_those_of_the_file) {
  Random random(31);
  double power = 1;
  for (int decimals = 0; decimals <= 11; ++decimals, power *= 10) {
    std::vector<LonLat> given;
    for (int i = 0; i < 300; ++i) {
      given.push_back({std::rint(179 * random.signed_unit() * power) / power,
                       std::rint(80 * random.signed_unit() * power) / power});
    }
    EXPECT_EQ(short_lonlats(unit_vectors(given)), given) << decimals;
  }
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i) points.push_back(random_direction(random));
  const std::vector<LonLat> found = short_lonlats(points);
  const std::vector<LonLat> usual = lonlats(points);
  const std::vector<Point> back = unit_vectors(found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(found[i] == usual[i] || back[i] == points[i]);
  }
  // Numbers with all their digits are other numbers then, of the same points.
  for (Point& point : points) point = unit_vectors(lonlats(std::array{point})).front();
  EXPECT_EQ(unit_vectors(short_lonlats(points)), points);
  const std::vector<LonLat> edges = {{-180, 10.5}, {0, 90}, {0, -90}, {180, 0}};
  const std::vector<Point> at_edges = unit_vectors(edges);
  EXPECT_EQ(unit_vectors(short_lonlats(at_edges)), at_edges);
}

}  // namespace
}  // namespace rondel::test::of_constrained_features
