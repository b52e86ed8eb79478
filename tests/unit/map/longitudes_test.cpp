// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The turn in which results have their longitudes, from features to meshes of triangles.
#include "rondel/longitudes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "map/longitudes.h"
#include "rondel/constrained_features.h"
#include "rondel/delaunay.h"
#include "rondel/geometries.h"
#include "rondel/mesh_triangles.h"

namespace rondel::test {
namespace {

TEST(longitudes, of_results_begin_where_those_given_do) {
  struct Case {
    LongitudeExtent given;
    double west_deg;
  };
  for (const auto& [given, west_deg] : std::vector<Case>{{{-180, 180}, -180},
                                                         {{-180.0000001, 180.00000006}, -180},
                                                         {{100, 170}, -180},
                                                         {{0, 360}, 0},
                                                         {{-1e-9, 360.0000001}, 0},
                                                         {{170, 200}, 0},
                                                         {{350, 370}, 350},
                                                         {{-280, 80}, -280},
                                                         {{-200, -160}, -200},
                                                         {{-180, 360}, -180},
                                                         {{}, -180}}) {
    EXPECT_EQ(west_of(given), west_deg) << given.least << ' ' << given.greatest;
    EXPECT_EQ(west_of({}, given), west_deg);
    EXPECT_EQ(west_of({5, 190}, given), 0);
  }
}

// The meridian of the ends has the longitude that the input has.
TEST(longitudes, of_one_end_of_the_turn_stay_there) {
  struct Case {
    LongitudeExtent given;
    double lon_deg;  // from lonlats()
    double expected;
  };
  for (const auto& [given, lon_deg, expected] : std::vector<Case>{{{-180, -170}, 180, -180},
                                                                  {{-180, 179.9}, 180, -180},
                                                                  {{-180, 180}, 180, 180},
                                                                  {{170, 180}, 180, 180},
                                                                  {{350, 360}, 0, 360},
                                                                  {{1, 360}, 0, 360},
                                                                  {{1, 360}, -0.5, 359.5},
                                                                  {{0, 360}, 0, 0},
                                                                  {{0, 350}, 0, 0}}) {
    EXPECT_EQ(map::longitude_in_turn(lon_deg, west_of(given)), expected);
    EXPECT_EQ(west_of({}, given), given.least < 0 || given.greatest <= 180 ? -180 : 0);
    EXPECT_NEAR(west_of(given), west_of({}, given), 1.1e-5);
  }
}

TEST(longitudes, are_moved_by_whole_turns) {
  EXPECT_EQ(map::longitude_in_turn(180, -180), 180);
  EXPECT_EQ(map::longitude_in_turn(-90, -180), -90);
  EXPECT_EQ(map::longitude_in_turn(-90, 0), 270);
  EXPECT_EQ(map::longitude_in_turn(180, 0), 180);
  EXPECT_EQ(map::longitude_in_turn(0, 0), 0);
  EXPECT_EQ(map::longitude_in_turn(-10, 350), 350);
  EXPECT_EQ(map::longitude_in_turn(10, 350), 370);
  EXPECT_EQ(map::longitude_in_turn(170, -200), -190);
  // Rounding moves places of the western border by some units in the last place.
  EXPECT_NEAR(map::longitude_in_turn(350.1 - 360 - 1e-13, 350.1), 350.1, 1e-12);
  EXPECT_EQ(map::longitude_in_turn(-1e-13, 0), -1e-13);
}

TEST(longitudes, of_points_are_the_short_ones_of_their_turn) {
  const std::vector<LonLat> given = {{200.3, 10.1}, {359.9, -5.7}, {0, 3}, {179.999, 80.25}};
  EXPECT_EQ(short_lonlats(unit_vectors(given), 0), given);
  const std::vector<LonLat> before = {{-279.7, 10.1}, {-100.3, 5}, {79.9, -20.25}};
  EXPECT_EQ(short_lonlats(unit_vectors(before), -280), before);
}

// Returns a feature of a box, and one of its southwestern corner.
LonLatGeometries box_and_corner(double west, double east) {
  LonLatGeometries made;
  auto& polygons = made.polygons.rows;
  polygons.rows.append(
      std::vector<LonLat>{{west, -5}, {east, -5}, {east, 5}, {west, 5}, {west, -5}});
  polygons.end_group();
  made.polygons.end_group();
  made.polygons.end_group();
  made.lines.end_group();
  made.lines.rows.append(std::vector<LonLat>{{west, -5}});
  made.lines.end_group();
  return made;
}

TEST(longitudes, of_features_are_those_of_their_positions) {
  const LonLatGeometries given = box_and_corner(170, 200);
  const std::vector<FeatureTable> tables = features_of_geometries({&given, 1});
  EXPECT_EQ(tables[0].longitudes, (std::vector<LongitudeExtent>{{170, 200}, {170, 170}}));
}

TEST(longitudes, of_meshes_are_in_the_turn_of_the_domain) {
  for (const double west : {170.0, 350.0, -190.0, 10.0}) {
    const LonLatGeometries given = box_and_corner(west, west + 30);
    std::vector<FeatureTable> tables = features_of_geometries({&given, 1});
    mesh::MeshDomain domain;
    domain.west_deg = west_of(tables[0].longitudes[0]);
    domain.area.push_back({tables[0].lines, tables[0].polygons});
    const mesh::TriangleMesh mesh = mesh::triangle_mesh(mesh::triangles(domain));
    EXPECT_GT(mesh.positions.size(), 4U);
    for (const LonLat& place : mesh.positions) {
      EXPECT_GE(place.lon_deg, west - 1e-12);
      EXPECT_LE(place.lon_deg, west + 30 + 1e-12);
    }
    const LonLat corner = {west + 30, 5};
    EXPECT_NE(std::ranges::find(mesh.positions, corner), mesh.positions.end()) << west;
  }
}

}  // namespace
}  // namespace rondel::test
