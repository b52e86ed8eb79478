// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Borders of meshes of triangles: against edges that are counted in a map, and cases drawn by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "support/random.h"
#include "support/thrown.h"
#include "unit/meshing/triangle_meshes.h"

namespace rondel::test {
namespace {

using mesh::BoundaryKind;
using mesh::BoundarySegment;
using mesh::TriangleMesh;
using Pair = std::array<Index, 2>;

// The edges of a segment in its direction.
std::vector<Pair> edges_of(const BoundarySegment& segment) {
  std::vector<Pair> edges;
  for (std::size_t k = 1; k < segment.nodes.size(); ++k) {
    edges.push_back({segment.nodes[k - 1], segment.nodes[k]});
  }
  if (segment.kind == BoundaryKind::island) {
    edges.push_back({segment.nodes.back(), segment.nodes.front()});
  }
  return edges;
}

// The edges of triangles whose reverse no triangle has.
std::set<Pair> border_by_counting(const std::vector<Triple>& triangles) {
  std::set<Pair> all;
  for (const auto& [a, b, c] : triangles) {
    all.insert({Pair{a, b}, Pair{b, c}, Pair{c, a}});
  }
  std::set<Pair> border;
  for (const auto& [a, b] : all) {
    if (all.count({b, a}) == 0) border.insert({a, b});
  }
  return border;
}

// Each edge of the border is in one segment, with the triangle to the left; a segment has no node
// twice.
void expect_whole_border(const TriangleMesh& mesh) {
  std::set<Pair> left = border_by_counting(mesh.triangles);
  for (const BoundarySegment& segment : mesh.boundary) {
    const std::set<Index> nodes(segment.nodes.begin(), segment.nodes.end());
    EXPECT_EQ(nodes.size(), segment.nodes.size());
    for (const Pair& edge : edges_of(segment)) EXPECT_EQ(left.erase(edge), 1U);
  }
  EXPECT_TRUE(left.empty());
  EXPECT_TRUE(std::ranges::is_sorted(mesh.boundary, {}, &BoundarySegment::kind));
}

std::map<BoundaryKind, std::size_t> kinds_of(const TriangleMesh& mesh) {
  std::map<BoundaryKind, std::size_t> counts;
  for (const BoundarySegment& segment : mesh.boundary) ++counts[segment.kind];
  return counts;
}

TEST(boundary_segments, of_a_basin_are_open_land_and_islands) {
  const TriangleMesh mesh = arctic_mesh(1);
  expect_whole_border(mesh);
  std::map<BoundaryKind, std::size_t> counts = kinds_of(mesh);
  EXPECT_EQ(counts[BoundaryKind::island], 2U);
  EXPECT_GE(counts[BoundaryKind::open], 1U);
  EXPECT_EQ(counts[BoundaryKind::open], counts[BoundaryKind::land]);
}

TEST(boundary_segments, of_all_oceans_are_islands) {
  const TriangleMesh mesh = global_mesh(2);
  expect_whole_border(mesh);
  EXPECT_EQ(kinds_of(mesh)[BoundaryKind::island], mesh.boundary.size());
  EXPECT_EQ(mesh.boundary.size(), 3U);
}

TEST(boundary_segments, of_a_closed_basin_are_two_linked_chains_of_land) {
  const TriangleMesh whole = arctic_mesh(3);
  const auto boundary = mesh::boundary_segments(whole.points, whole.triangles);
  ASSERT_EQ(boundary.size(), 4U);
  EXPECT_EQ(boundary[0].kind, BoundaryKind::land);
  EXPECT_EQ(boundary[1].kind, BoundaryKind::land);
  EXPECT_EQ(boundary[0].nodes.back(), boundary[1].nodes.front());
  EXPECT_EQ(boundary[1].nodes.back(), boundary[0].nodes.front());
  EXPECT_EQ(boundary[0].nodes.front(), std::min(*std::ranges::min_element(boundary[0].nodes),
                                                *std::ranges::min_element(boundary[1].nodes)));
  EXPECT_EQ(boundary[3].kind, BoundaryKind::island);
  const auto open = mesh::boundary_segments(whole.points, whole.triangles, std::vector<Pair>{});
  EXPECT_EQ(std::ranges::count(open, BoundaryKind::open, &BoundarySegment::kind), 6);
}

TEST(boundary_segments, of_any_triangles_cover_the_border) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const double share = random.unit();
    const TriangleMesh mesh = mesh_of(
        positions_with_poles(60, seed),
        [&](const Point&, std::size_t) { return random.unit() < share; },
        [&](const Point&) { return random.unit() < 0.7; });
    expect_whole_border(mesh);
    mesh::require_valid(mesh);
    std::map<Index, int> passes;
    for (const auto& [a, b] : border_by_counting(mesh.triangles)) ++passes[a];
    std::vector<Index> pinched;
    for (const auto& [node, count] : passes) {
      if (count > 1) pinched.push_back(node);
    }
    EXPECT_EQ(mesh::pinched_nodes(mesh), pinched);
  }
}

// A hemisphere, half of whose circle is a border, is a basin; larger caps are the sphere but for an
// island.
TEST(boundary_segments, take_the_gap_of_half_the_sphere_for_the_outside) {
  const std::vector<Point> points = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                     {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<Triple> north = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  const auto half = mesh::boundary_segments(points, north);
  ASSERT_EQ(half.size(), 2U);
  EXPECT_EQ(half[0], (BoundarySegment{BoundaryKind::land, {1, 2, 3}}));
  EXPECT_EQ(half[1], (BoundarySegment{BoundaryKind::land, {3, 4, 1}}));
  north.push_back({2, 1, 5});
  const auto more = mesh::boundary_segments(points, north);
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(more[0], (BoundarySegment{BoundaryKind::island, {1, 5, 2, 3, 4}}));
  north.insert(north.end(), {{3, 2, 5}, {4, 3, 5}, {1, 4, 5}});
  EXPECT_TRUE(mesh::boundary_segments(points, north).empty());
}

// Positions (0, 0) ... (n, n) tenths of a degree, and two triangles for each square that is marked.
TriangleMesh squares(const std::vector<std::string>& rows) {
  std::vector<LonLat> positions;
  std::vector<Triple> triangles;
  const auto n = static_cast<Index>(rows[0].size() + 1);
  for (Index y = 0; y <= rows.size(); ++y) {
    for (Index x = 0; x < n; ++x) positions.push_back({0.1 * x, 0.1 * y});
  }
  for (Index y = 0; y < rows.size(); ++y) {
    for (Index x = 0; x < rows[y].size(); ++x) {
      if (rows[y][x] != '#') continue;
      const Index a = y * n + x;
      triangles.insert(triangles.end(), {{a, a + 1, a + n + 1}, {a, a + n + 1, a + n}});
    }
  }
  return mesh::triangle_mesh(unit_vectors(positions), positions, triangles);
}

// Triangles that overlap may meet in a node such that no walk along the border is closed.
TEST(boundary_segments, of_triangles_that_overlap_name_a_node) {
  EXPECT_EQ(thrown_message<InvalidInput>([] {
              mesh::triangle_mesh(
                  unit_vectors(std::vector<LonLat>{{1, 3}, {1, 0}, {2, 2}, {4, 6}, {6, 2}, {0, 3}}),
                  {}, std::vector<Triple>{{5, 4, 3}, {5, 2, 0}});
            }),
            "triangles overlap around node 4");
  Random random(6);
  int num_refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<LonLat> positions(7);
    for (LonLat& place : positions) place = {9 * random.unit(), 9 * random.unit()};
    const std::vector<Point> points = unit_vectors(positions);
    std::vector<Triple> triangles;
    for (std::size_t t = 0; t < 3; ++t) {
      Triple triangle;
      for (Index& corner : triangle) corner = static_cast<Index>(7 * random.unit());
      const auto& [a, b, c] = triangle;
      if (a == b || b == c || c == a) continue;
      if (orientation(points[a], points[b], points[c]) == Sign::negative)
        std::swap(triangle[0], triangle[1]);
      triangles.push_back(triangle);
    }
    const std::string text = thrown_message<InvalidInput>(
        [&] { mesh::require_valid(mesh::triangle_mesh(points, {}, triangles)); });
    const bool is_overlap = text.starts_with("triangles overlap around node ");
    EXPECT_TRUE(text.empty() || is_overlap || text.starts_with("triangle ")) << text;
    num_refused += is_overlap ? 1 : 0;
  }
  EXPECT_GT(num_refused, 100);
}

TEST(boundary_segments, of_islands_that_touch_are_islands_each) {
  const TriangleMesh mesh = squares({"####", "#.##", "##.#", "####"});
  expect_whole_border(mesh);
  EXPECT_EQ(kinds_of(mesh)[BoundaryKind::island], 2U);
  EXPECT_EQ(mesh.boundary.back().nodes.size(), 4U);
  EXPECT_EQ(mesh::pinched_nodes(mesh), std::vector<Index>{12});
}

TEST(boundary_segments, of_basins_that_touch_are_those_of_each) {
  const TriangleMesh mesh = squares({"#.", ".#"});
  expect_whole_border(mesh);
  EXPECT_EQ(kinds_of(mesh)[BoundaryKind::land], 4U);
  EXPECT_EQ(mesh.points.size(), 7U);
  EXPECT_EQ(mesh::pinched_nodes(mesh).size(), 1U);
}

TEST(boundary_segments, of_an_island_at_the_coast_are_coast_and_island) {
  const TriangleMesh mesh = squares({"###", "#.#", "##."});
  expect_whole_border(mesh);
  EXPECT_EQ(kinds_of(mesh)[BoundaryKind::land], 2U);
  EXPECT_EQ(kinds_of(mesh)[BoundaryKind::island], 1U);
}

// A crack without area, and a mesh of a few metres.
TEST(boundary_segments, of_thin_gaps_are_islands) {
  std::vector<LonLat> positions = {{-60, 0}, {0, 0}, {60, 0}, {0, 0}, {0, 70}, {0, -70}};
  const std::vector<Point> points = unit_vectors(positions);
  const std::vector<Triple> triangles = {{0, 1, 4}, {1, 2, 4}, {3, 0, 5}, {2, 3, 5}};
  const auto crack = mesh::boundary_segments(points, triangles);
  const auto islands = std::ranges::count(crack, BoundaryKind::island, &BoundarySegment::kind);
  EXPECT_EQ(islands, 1);
  EXPECT_EQ(crack.size(), 3U);
  std::vector<LonLat> harbor;
  for (const auto& [lon, lat] :
       std::vector<LonLat>{{0, 0}, {3, 0}, {0, 3}, {1, 1}, {1.5, 1}, {1, 1.5}}) {
    harbor.push_back({5 + 1e-5 * lon, 50 + 1e-5 * lat});
  }
  const std::vector<Triple> ring = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5},
                                    {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  const TriangleMesh mesh = mesh::triangle_mesh(unit_vectors(harbor), harbor, ring);
  ASSERT_EQ(mesh.boundary.size(), 3U);
  EXPECT_EQ(mesh.boundary[2], (BoundarySegment{BoundaryKind::island, {3, 5, 4}}));
}

TEST(triangle_mesh, leaves_out_points_without_triangles) {
  const std::vector<Point> points = {{0, 0, 1}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
  const TriangleMesh mesh = mesh::triangle_mesh(points, {}, std::vector<Triple>{{0, 2, 3}},
                                                std::vector<Pair>{{3, 0}, {0, 1}});
  EXPECT_EQ(mesh.points, (std::vector<Point>{points[0], points[2], points[3]}));
  EXPECT_EQ(mesh.triangles, std::vector<Triple>({{0, 1, 2}}));
  ASSERT_EQ(mesh.boundary.size(), 2U);
  EXPECT_EQ(mesh.boundary[0], (BoundarySegment{BoundaryKind::open, {0, 1, 2}}));
  EXPECT_EQ(mesh.boundary[1], (BoundarySegment{BoundaryKind::land, {2, 0}}));
  const std::vector<Triple> triangles = {{0, 2, 3}};
  const auto with_depths = [&](const std::vector<double>& depths) {
    return mesh::triangle_mesh(points, {}, triangles, std::nullopt, depths).depths;
  };
  EXPECT_EQ(with_depths({5, 6, 7, 8}), (std::vector<double>{5, 7, 8}));
  EXPECT_EQ(with_depths({}), std::vector<double>{});
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return with_depths({5, 6, 7});
            }),
            "there are 3 depths for 4 points");
}

TEST(triangle_mesh, may_be_empty) {
  const TriangleMesh mesh = mesh::triangle_mesh({}, {}, {});
  EXPECT_TRUE(mesh.boundary.empty());
  mesh::require_valid(mesh);
}

// What is wrong is named, with its position.
TEST(triangle_mesh, refuses_what_is_no_mesh) {
  const std::vector<Point> points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}};
  const auto message = [&](const std::vector<Triple>& triangles) {
    return thrown_message<InvalidInput>([&] { return mesh::boundary_segments(points, triangles); });
  };
  EXPECT_EQ(message({{0, 1, 4}}), "triangle 0 has the corner 4; there are 4 nodes");
  EXPECT_EQ(message({{0, 1, 2}, {0, 3, 3}}), "triangle 1 has the corner 3 twice");
  EXPECT_EQ(
      message({{0, 1, 2}, {3, 0, 1}}),
      "triangle 0 has the edge between nodes 0 and 1 in the direction in which triangle 1 has "
      "it");
  const auto fault = [&](const std::function<void(TriangleMesh&)>& change) {
    TriangleMesh mesh = {points, {}, {{0, 1, 2}, {1, 3, 2}}, {}, {}, {}};
    mesh.boundary = mesh::boundary_segments(mesh.points, mesh.triangles);
    mesh::require_valid(mesh);
    change(mesh);
    return thrown_message<InvalidInput>([&] {
      mesh::require_valid(mesh);
      return 0;
    });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault([](auto& mesh) { mesh.depths = {1}; }), "there are 1 depths for 4 nodes");
  EXPECT_EQ(fault([](auto& mesh) { mesh.positions = {{}}; }), "there are 1 positions for 4 nodes");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.depths = {1, 2, nan, 4};
            }),
            "node 2 has a depth that is not finite");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.positions = {{}, {}, {}, {0, 91}};
            }),
            "node 3 has no longitude and latitude in degrees");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.points[1] = {0, 0, 0};
            }),
            "node 1 is at the center of the sphere");
  EXPECT_EQ(fault([](auto& mesh) { mesh.points[1].y = nan; }),
            "node 1 has coordinates that are not finite, or too large");
  EXPECT_EQ(fault([](auto& mesh) { std::swap(mesh.triangles[1][0], mesh.triangles[1][1]); }),
            "triangle 1 is clockwise: nodes 3, 1 and 2");
  EXPECT_EQ(fault([](auto& mesh) { mesh.points[2] = mesh.points[1]; }),
            "triangle 0 has no area: nodes 0, 1 and 2");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.points.push_back({0, 0, -1});
            }),
            "node 4 is in no triangle");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.boundary[1].nodes = {1, 2};
            }),
            "segment 1: nodes 1 and 2 are not joined by an edge of the border");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.boundary[1].nodes = {1, 9};
            }),
            "segment 1 has the node 9; there are 4 nodes");
  EXPECT_EQ(fault([](auto& mesh) { mesh.boundary[0].nodes = {1}; }), "segment 0 has 1 node");
  EXPECT_EQ(fault([](auto& mesh) { mesh.boundary[0].kind = BoundaryKind{7}; }),
            "segment 0 has no kind");
  EXPECT_EQ(fault([](auto& mesh) { mesh.boundary[0].type = 24; }),
            "segment 0 has the type 24, which is not one of land segments that has to be said");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.levels = {0, 1};
            }),
            "there are 2 levels; three are needed, or none");
  EXPECT_EQ(fault([](auto& mesh) {
              mesh.levels = {0, 1, 1};
            }),
            "level 2 is not finite, or not deeper than the one before");
}

}  // namespace
}  // namespace rondel::test
