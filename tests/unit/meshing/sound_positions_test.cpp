// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Positions in degrees of meshes with slivers, by the exact orientation of what a reader makes of them.
#include "meshing/sound_positions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "inputs/random.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/triangle_mesh.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

using mesh::TriangleMesh;

std::size_t num_turned_over(const TriangleMesh& mesh, std::span<const LonLat> positions) {
  const std::vector<Point> points = unit_vectors(positions);
  return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, [&](const Triple& t) {
    return orientation(points[t[0]], points[t[1]], points[t[2]]) != Sign::positive;
  }));
}

// Lines between places of a grid of degrees, with a node where they cross or touch: there slivers are.
TriangleMesh mesh_of_lines(inputs::Random& random, std::size_t num_lines) {
  std::vector<LonLat> places;
  std::vector<std::array<Index, 2>> lines;
  const auto place = [&] {
    const auto degree = [&] { return static_cast<double>(random.next() % 6); };
    const LonLat at = {degree(), degree()};
    const auto known = std::ranges::find(places, at);
    if (known != places.end()) return static_cast<Index>(known - places.begin());
    places.push_back(at);
    return static_cast<Index>(places.size() - 1);
  };
  while (lines.size() < num_lines) {
    const Index a = place();
    const Index b = place();
    if (a != b) lines.push_back({a, b});
  }
  const ConstrainedTriangulation made = constrained_delaunay(
      Sites(unit_vectors(places)), lines, {.crossings = ConstraintCrossings::split});
  std::vector<Triple> triangles;
  for (Index f = 0; f < made.triangulation.num_faces(); ++f) {
    if (!made.triangulation.is_ghost(f)) triangles.push_back(made.triangulation.faces()[f]);
  }
  const auto points = made.triangulation.sites().points();
  return mesh::triangle_mesh(points, {}, triangles);
}

TEST(sound_positions, no_triangle_of_lines_that_touch_is_turned_over) {
  inputs::Random random(7);
  std::size_t num_with_usual = 0;
  for (int i = 0; i < 400; ++i) {
    const TriangleMesh mesh = mesh_of_lines(random, 4);
    if (mesh.triangles.empty()) continue;
    num_with_usual += num_turned_over(mesh, lonlats(mesh.points));
    EXPECT_EQ(num_turned_over(mesh, meshing::sound_positions(mesh)), 0U) << i;
  }
  EXPECT_GT(num_with_usual, 0U);
}

TEST(sound_positions, given_ones_and_those_of_few_decimals_stay) {
  const std::vector<LonLat> given = {{200.5, 3}, {210, 3.25}, {205, 11.1}};
  TriangleMesh mesh =
      mesh::triangle_mesh(unit_vectors(given), given, std::vector<Triple>{{0, 1, 2}});
  EXPECT_EQ(meshing::sound_positions(mesh), given);
  mesh.positions.clear();
  const std::vector<LonLat> in_the_west = {{-159.5, 3}, {-150, 3.25}, {-155, 11.1}};
  EXPECT_EQ(meshing::sound_positions(mesh), in_the_west);
}

// These nodes differ by less than degrees can tell.
TEST(sound_positions, triangles_without_area_in_degrees_are_refused) {
  const Point a = {1, 0, 0};
  const TriangleMesh mesh =
      mesh::triangle_mesh(std::vector<Point>{a, {1, 0x1p-1000, 0}, {1, 0, 0x1p-1000}}, {},
                          std::vector<Triple>{{0, 1, 2}});
  EXPECT_NO_THROW(require_valid(mesh));
  EXPECT_EQ(thrown_message<InvalidInput>([&] { (void)meshing::sound_positions(mesh); }),
            "triangle 0 at longitude 0, latitude 0 is so narrow that it has no area in degrees");
}

}  // namespace
}  // namespace rondel::test
