// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// SolidStars and SolidRings: the neighbors of a vertex, and theirs, along edges of solid faces.
//
//     . . . . .        The first ring around the middle of a grid has its neighbors, the second one theirs. Edges of ghost
//     . o o o .        faces, which join sites that are far apart, do not count.
//     . o x o .
//     . o o o .
//     . . . . .
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "interpolation/solid_rings.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test::of_rings {
namespace {

using interpolation::PreparedTriangulation;
using interpolation::SolidRings;
using interpolation::SolidStars;

// The vertices that solid faces join with each vertex, by rank.
std::vector<std::set<Index>> neighbors_of(const Triangulation& triangulation,
                                          const PreparedTriangulation& prepared) {
  std::vector<std::set<Index>> neighbors(prepared.num_vertices());
  for (Index face = 0; face < triangulation.num_faces(); ++face) {
    if (triangulation.is_ghost(face)) continue;
    for (const Index a : triangulation.faces()[face]) {
      for (const Index b : triangulation.faces()[face]) {
        if (a != b) neighbors[prepared.vertex_of(a)].insert(prepared.vertex_of(b));
      }
    }
  }
  return neighbors;
}

void expect_rings(const std::vector<Point>& sites) {
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  const SolidStars stars(prepared, 2);
  const std::vector<std::set<Index>> neighbors = neighbors_of(triangulation, prepared);
  ASSERT_EQ(stars.size(), neighbors.size());
  SolidRings rings(stars);
  for (Index v = 0; v < stars.size(); ++v) {
    EXPECT_EQ(std::set<Index>(stars[v].begin(), stars[v].end()), neighbors[v]);
    ASSERT_FALSE(stars[v].empty());
    EXPECT_EQ(stars[v][0], *neighbors[v].begin());  // from the lowest rank on
    // Counterclockwise: each end is to the left of the way to the end before it, but for one gap at the border.
    std::size_t num_right = 0;
    for (std::size_t k = 0; k < stars[v].size(); ++k) {
      const Point& here = prepared.point(stars[v][k]);
      const Point& next = prepared.point(stars[v][(k + 1) % stars[v].size()]);
      num_right += dot(prepared.point(v), cross(here, next)) > 0 ? 0 : 1;
    }
    EXPECT_LE(num_right, 1U);
    std::set<Index> within = {v};
    for (unsigned number = 1; number < 5; ++number) {
      std::set<Index> more = within;
      for (const Index w : within) more.insert(neighbors[w].begin(), neighbors[w].end());
      within = more;
      const std::span<const Index> found = rings.find(v, number);
      std::set<Index> all(found.begin(), found.end());
      EXPECT_EQ(all.size(), found.size());  // each once
      EXPECT_FALSE(all.contains(v));
      all.insert(v);
      EXPECT_EQ(all, within) << v << ' ' << number;
    }
    EXPECT_TRUE(rings.find(v, 0).empty());
  }
}

TEST(solid_rings, of_an_octahedron) {
  expect_rings({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
}

// A grid on a part of the sphere has ghost faces between its border and the other side of the sphere.
TEST(solid_rings, of_a_grid_leave_out_ghosts) {
  std::vector<Point> sites;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) sites.push_back(normalized(Point{1, 0.1 * x, 0.1 * y}));
  }
  expect_rings(sites);
  // A ring begins where the one before ends: the nearest vertices come first.
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  const SolidStars stars(prepared, 1);
  SolidRings rings(stars);
  const Index middle = prepared.vertex_of(12);
  const std::vector<Index> first(rings.find(middle, 1).begin(), rings.find(middle, 1).end());
  const std::span<const Index> second = rings.find(middle, 2);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), second.begin()));
}

TEST(solid_rings, of_random_sites) {
  Random random(90);
  for (const std::size_t n : {4U, 12U, 60U}) {
    std::vector<Point> sites(n);
    std::ranges::generate(sites, [&] { return random.direction(); });
    expect_rings(sites);
    for (Point& p : sites) p = normalized(Point{1, 0, 0} + 0.2 * p);
    expect_rings(sites);
  }
}

}  // namespace
}  // namespace rondel::test::of_rings
