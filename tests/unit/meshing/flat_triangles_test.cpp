// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles without area in degrees: left out on the border, and refused elsewhere. Areas are those of
// whole degrees, exactly.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/triangle_files.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

using mesh::TriangleMesh;
using NodePairs = std::vector<std::array<Index, 2>>;

// A grid of 5 degrees, 9 x 9 nodes, whose southwest corner is there.
std::vector<LonLat> degrees_of_grid(double west, double south) {
  std::vector<LonLat> positions;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) positions.push_back({west + 5 * i, south + 5 * j});
  }
  return positions;
}

std::vector<Triple> solid_faces(const Triangulation& triangulation) {
  std::vector<Triple> faces;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    if (!triangulation.is_ghost(f)) faces.push_back(triangulation.faces()[f]);
  }
  return faces;
}

std::size_t num_flat(const std::vector<LonLat>& positions, const std::vector<Triple>& triangles) {
  return static_cast<std::size_t>(std::ranges::count_if(triangles, [&](const Triple& t) {
    const LonLat& a = positions[t[0]];
    const LonLat& b = positions[t[1]];
    const LonLat& c = positions[t[2]];
    return (b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) <=
           (b.lat_deg - a.lat_deg) * (c.lon_deg - a.lon_deg);
  }));
}

TEST(flat_triangles, of_grids_are_left_out_on_meridians_and_parallels) {
  std::size_t num_slivers = 0;
  for (const double west : {-20.0, 3.0, 160.0}) {
    for (const double south : {-20.0, 25.0, -70.0}) {
      const std::vector<LonLat> positions = degrees_of_grid(west, south);
      std::vector<Triple> triangles = solid_faces(delaunay(unit_vectors(positions)));
      const std::size_t flat = num_flat(positions, triangles);
      num_slivers += flat;
      EXPECT_EQ(mesh::leave_out_flat(positions, triangles), flat) << west << ' ' << south;
      EXPECT_EQ(triangles.size(), 128U);
      EXPECT_EQ(num_flat(positions, triangles), 0U);
    }
  }
  EXPECT_GT(num_slivers, 9U * 14U);
}

TEST(flat_triangles, stay_where_their_long_side_is_a_constraint_or_inside) {
  const std::vector<LonLat> positions = {{0, 0}, {0, 10}, {0, 5}, {5, 5}, {-5, 5}};
  const std::vector<Triple> sliver = {{1, 0, 2}, {0, 3, 2}, {2, 3, 1}};
  std::vector<Triple> triangles = sliver;
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles, NodePairs{{1, 0}}), 0U);
  EXPECT_EQ(triangles, sliver);
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles, NodePairs{{0, 2}}), 1U);
  EXPECT_EQ(triangles, (std::vector<Triple>{{0, 3, 2}, {2, 3, 1}}));
  std::vector<Triple> inside = sliver;
  inside.push_back({0, 1, 4});
  EXPECT_EQ(mesh::leave_out_flat(positions, inside), 0U);
  inside.push_back({9, 0, 4});
  EXPECT_EQ(thrown_message<InvalidInput>([&] { mesh::leave_out_flat(positions, inside); }),
            "triangle 4 has a corner that is no node");
}

// One node of a parallel has the latitude beside the others'.
TEST(flat_triangles, are_also_those_that_rounding_makes_a_little_higher) {
  const double beside = std::nextafter(30.12, 90.0);
  const std::vector<LonLat> positions = {{0, 30.12}, {4, 30.12}, {2, beside}, {1, 30.12},
                                         {3, 30.12}, {2, 25},    {2, 40}};
  const std::vector<Triple> slivers = {{1, 0, 3}, {1, 3, 2}, {1, 2, 4}};
  std::vector<Triple> triangles = slivers;
  const std::vector<Triple> others = {{0, 5, 3}, {3, 5, 2}, {2, 5, 4}, {4, 5, 1}};
  triangles.insert(triangles.end(), others.begin(), others.end());
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles), 3U);
  EXPECT_EQ(triangles, others);
  triangles = {{0, 3, 6}, {3, 2, 6}, {0, 2, 3}};
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles), 1U);
}

TEST(flat_triangles, around_a_pole_and_across_the_turn_are_those_of_the_sphere) {
  std::vector<LonLat> positions = {{170, 0}, {-170, 0}, {180, 10}, {0, 90}};
  std::vector<Triple> triangles = {{0, 1, 2}, {2, 1, 3}, {0, 2, 3}};
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles), 0U);
  positions = {{0, 80}, {120, 80}, {-120, 80}};
  triangles = {{0, 1, 2}};
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles), 0U);
  positions = {{175, 0}, {-175, 0}, {180, 0}};
  EXPECT_EQ(mesh::leave_out_flat(positions, triangles), 1U);
}

TEST(flat_triangles, are_refused_in_files_of_models_in_degrees) {
  // The middle node of a parallel is south of the great circle between its ends.
  const std::vector<LonLat> positions = {{0, 50}, {20, 50}, {10, 50}};
  const TriangleMesh mesh =
      mesh::triangle_mesh(unit_vectors(positions), positions, std::vector<Triple>{{0, 2, 1}});
  const auto written = [&](const char* format) {
    std::string bytes;
    mesh::write_triangle_mesh(FileName::in_memory(bytes, format), mesh);
    return bytes;
  };
  for (const char* const format : {"adcirc", "schism", "sms"}) {
    EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)written(format); }),
              "triangle 0 at longitude 0, latitude 50 has no area in degrees: its corners are on "
              "one line");
  }
  for (const char* const format : {"gmsh", "ugrid"}) EXPECT_FALSE(written(format).empty());
  EXPECT_TRUE(mesh::has_nodes_in_degrees("a.14"));
  EXPECT_TRUE(mesh::has_nodes_in_degrees("a.nc"));
  EXPECT_FALSE(mesh::has_nodes_in_degrees("a.msh"));
  EXPECT_FALSE(mesh::has_nodes_in_degrees("a.ply"));
}

}  // namespace
}  // namespace rondel::test
