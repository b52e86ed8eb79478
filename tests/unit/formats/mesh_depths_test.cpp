// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Depths that are read from a mesh of triangles: in its own triangles, which need not be Delaunay, on
// its border up to rounding, and beyond it those of the nearest node. The oracles are its own depths,
// and barycentric coordinates by determinants.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "inputs/random.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_size_files.h"
#include "rondel/triangle_files.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

using mesh::TriangleMesh;
using Remarks = std::vector<std::string>;

// A box of degrees with an island in its middle, whose sides are meridians. Diagonals are not those of
// Delaunay: cells are narrow, and sheared.
TriangleMesh mesh_with_island(bool has_overlap = false) {
  constexpr Index columns = 19;
  constexpr Index rows = 17;
  std::vector<LonLat> positions;
  std::vector<double> depths;
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < columns; ++i) {
      const bool is_inner = i > 0 && i + 1 < columns;
      positions.push_back({static_cast<double>(i) - 9 + (is_inner ? 0.04 * j : 0.0),
                           (static_cast<double>(j) - 8) * 0.7});
      depths.push_back((i + 7 * j) % 3 == 0 ? 10 : 3000);
    }
  }
  std::vector<Triple> triangles;
  for (Index j = 0; j + 1 < rows; ++j) {
    for (Index i = 0; i + 1 < columns; ++i) {
      if (i > 6 && i < 11 && j > 5 && j < 10) continue;
      const Index a = j * columns + i;
      triangles.push_back({a, a + 1, a + columns + 1});
      triangles.push_back({a, a + columns + 1, a + columns});
    }
  }
  if (has_overlap) {
    const auto next = static_cast<Index>(positions.size());
    for (const LonLat& place : {LonLat{0.3, 3}, {2.7, 3.1}, {1.2, 4.9}}) {
      positions.push_back(place);
      depths.push_back(50);
    }
    triangles.push_back({next, next + 1, next + 2});
  }
  return mesh::triangle_mesh(unit_vectors(positions), positions, triangles, std::nullopt, depths);
}

std::vector<double> depths_at(const FileName& file, std::span<const Point> nodes,
                              Remarks* remarks = nullptr) {
  return mesh::read_heights(file, "", mesh::Positive::down, nodes, {}, remarks);
}

double determinant_of(const Point& a, const Point& b, const Point& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}

Point place_between(const Point& a, const Point& b, double share) {
  const Point p = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
  const double length = std::hypot(p.x, p.y, p.z);
  return {p.x / length, p.y / length, p.z / length};
}

TEST(mesh_depths, are_those_of_the_mesh_at_its_own_nodes) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = mesh_with_island();
  inputs::Random random(3);
  std::vector<Point> nodes = mesh.points;
  for (Point& node : nodes) {
    const auto off = [&] { return 0x1p-53 * (static_cast<double>(random.next() % 5) - 2); };
    node = {node.x + off(), node.y + off(), node.z + off()};
  }
  for (const char* const name : {"a.14", "a.gr3", "a.2dm", "a.msh", "a.nc"}) {
    mesh::write_triangle_mesh(folder.file(name), mesh);
    Remarks remarks;
    EXPECT_EQ(depths_at(folder.file(name), nodes, &remarks), mesh.depths) << name;
    EXPECT_EQ(remarks, Remarks{}) << name;
  }
  mesh::write_triangle_mesh({folder.file("f"), "fesom"}, mesh);
  EXPECT_EQ(depths_at(folder.file("f"), nodes), mesh.depths);
}

TEST(mesh_depths, are_linear_in_each_triangle_and_on_the_border) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = mesh_with_island();
  mesh::write_triangle_mesh(folder.file("a.14"), mesh);
  inputs::Random random(5);
  std::vector<Point> places;
  std::vector<double> expected;
  const auto share = [&] { return 0.05 + 0.9 * static_cast<double>(random.next() % 1000) / 1000; };
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point& a = mesh.points[i];
    const Point& b = mesh.points[j];
    const Point& c = mesh.points[k];
    const Point p = place_between(place_between(a, b, share()), c, share());
    const double of_a = determinant_of(p, b, c);
    const double of_b = determinant_of(p, c, a);
    const double of_c = determinant_of(p, a, b);
    places.push_back(p);
    expected.push_back((of_a * mesh.depths[i] + of_b * mesh.depths[j] + of_c * mesh.depths[k]) /
                       (of_a + of_b + of_c));
  }
  for (const mesh::BoundarySegment& segment : mesh.boundary) {
    for (std::size_t n = 0; n + 1 < segment.nodes.size(); ++n) {
      const Index a = segment.nodes[n];
      const Index b = segment.nodes[n + 1];
      places.push_back(place_between(mesh.points[a], mesh.points[b], 0.5));
      expected.push_back((mesh.depths[a] + mesh.depths[b]) / 2);
    }
  }
  Remarks remarks;
  const std::vector<double> depths = depths_at(folder.file("a.14"), places, &remarks);
  for (std::size_t t = 0; t < places.size(); ++t) ASSERT_NEAR(depths[t], expected[t], 1e-7) << t;
  EXPECT_EQ(remarks, Remarks{});
}

// The node that is nearest to the middle of the long side is opposite of it.
TEST(mesh_depths, are_linear_on_a_side_whose_ends_are_not_the_nearest_nodes) {
  const TemporaryDirectory folder;
  const std::vector<LonLat> positions = {{0, 0.3}, {10.1, 0.7}, {5, 1.3}};
  const std::vector<Triple> triangles = {{0, 1, 2}};
  const std::vector<double> values = {100, 300, 1000};
  const TriangleMesh mesh =
      mesh::triangle_mesh(unit_vectors(positions), positions, triangles, std::nullopt, values);
  mesh::write_triangle_mesh(folder.file("a.14"), mesh);
  std::vector<Point> places;
  std::vector<double> expected;
  for (int k = 1; k < 200; ++k) {
    const Point p = place_between(mesh.points[0], mesh.points[1], k / 200.0);
    const auto from = [&](const Point& q) { return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z); };
    const double share = from(mesh.points[0]) / (from(mesh.points[0]) + from(mesh.points[1]));
    places.push_back(p);
    expected.push_back(100 + 200 * share);
  }
  Remarks remarks;
  const std::vector<double> depths = depths_at(folder.file("a.14"), places, &remarks);
  for (std::size_t t = 0; t < places.size(); ++t) ASSERT_NEAR(depths[t], expected[t], 0.3) << t;
  EXPECT_EQ(remarks, Remarks{});
}

TEST(mesh_depths, are_those_of_the_nearest_node_on_islands_and_beyond) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = mesh_with_island();
  mesh::write_triangle_mesh(folder.file("a.nc"), mesh);
  const std::vector<Point> places = unit_vectors(std::vector<LonLat>{
      {0.6, 0.2}, {-1.2, -0.3}, {0.9, 1.1}, {12, 3}, {-9.3, 2.2}, {2, 14}, {180, 0}});
  std::vector<double> expected;
  for (const Point& p : places) {
    const auto nearness = [&p](const Point& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
    const auto nearest = std::ranges::max_element(mesh.points, {}, nearness);
    expected.push_back(mesh.depths[static_cast<std::size_t>(nearest - mesh.points.begin())]);
  }
  Remarks remarks;
  EXPECT_EQ(depths_at(folder.file("a.nc"), places, &remarks), expected);
  EXPECT_EQ(remarks, Remarks{"7 of 7 nodes are outside of the places with values: the value of the "
                             "nearest place counts"});
}

TEST(mesh_depths, of_triangles_that_overlap_are_between_the_nodes) {
  const TemporaryDirectory folder;
  const TriangleMesh mesh = mesh_with_island(true);
  mesh::write_triangle_mesh(folder.file("a.2dm"), mesh);
  Remarks remarks;
  const std::vector<double> depths = depths_at(folder.file("a.2dm"), mesh.points, &remarks);
  for (std::size_t i = 0; i < depths.size(); ++i) EXPECT_NEAR(depths[i], mesh.depths[i], 1e-9);
  EXPECT_EQ(remarks, Remarks{"triangles of the mesh overlap, or have nodes on their sides: values "
                             "are linear on the Delaunay triangulation of its nodes"});
}

}  // namespace
}  // namespace rondel::test
