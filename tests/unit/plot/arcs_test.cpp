// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks which arcs a figure shows.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "api/triangulation_impl.h"
#include "globe.h"
#include "plot_arcs.h"

namespace rondel::cli {
namespace {

std::set<std::set<Index>> undirected(const std::vector<ArcEnds>& arcs) {
  std::set<std::set<Index>> result;
  for (const auto& [a, b] : arcs) result.insert({a, b});
  return result;
}

// A tetrahedron; face i is opposite to site i.
Triangulation tetrahedron(std::vector<Index> ghost_faces) {
  TriangulationArrays arrays;
  arrays.dimension = 2;
  arrays.faces = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  arrays.neighbors = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  arrays.num_sites = 4;
  arrays.ghost_faces = std::move(ghost_faces);
  return api::make_triangulation({}, std::move(arrays), {}, {});
}

Triangulation ring(std::vector<Index> order) {
  TriangulationArrays arrays;
  arrays.num_sites = order.size();
  arrays.dimension = 1;
  arrays.ring = std::move(order);
  return api::make_triangulation({}, std::move(arrays), {}, {});
}

Point on_equator(double radians) { return {std::cos(radians), std::sin(radians), 0}; }

TEST(triangulation_arcs, has_each_edge_once) {
  const auto arcs = triangulation_arcs(tetrahedron({}), {});
  EXPECT_EQ(arcs.size(), 6U);
  EXPECT_EQ(undirected(arcs).size(), 6U);
}

TEST(triangulation_arcs, leaves_out_edges_between_ghost_faces) {
  // Of two ghost faces, 2 and 3, the common edge 0 1 is not seen; the others bound solid faces.
  const auto arcs = triangulation_arcs(tetrahedron({2, 3}), {});
  EXPECT_EQ(arcs.size(), 5U);
  EXPECT_EQ(undirected(arcs).size(), 5U);
  EXPECT_EQ(undirected(arcs).count({0, 1}), 0U);
  EXPECT_TRUE(triangulation_arcs(tetrahedron({0, 1, 2, 3}), {}).empty());
}

TEST(triangulation_arcs, of_a_ring_around_the_sphere_close_it) {
  const std::vector<Point> sites{on_equator(0), on_equator(2.2), on_equator(4.1)};
  EXPECT_EQ(undirected(triangulation_arcs(ring({0, 1, 2}), sites)).size(), 3U);
}

TEST(triangulation_arcs, of_a_ring_leave_a_gap_beyond_180_degrees_open) {
  const std::vector<Point> sites{on_equator(1.5), on_equator(0), on_equator(0.5), on_equator(2.5)};
  const auto arcs = undirected(triangulation_arcs(ring({1, 2, 0, 3}), sites));
  const std::set<std::set<Index>> expected{{1, 2}, {2, 0}, {0, 3}};
  EXPECT_EQ(arcs, expected);
}

TEST(triangulation_arcs, join_two_sites_once_and_antipodal_ones_not_at_all) {
  const std::vector<Point> sites{on_equator(0), on_equator(2)};
  EXPECT_EQ(triangulation_arcs(ring({0, 1}), sites).size(), 1U);
  const std::vector<Point> antipodal{{1, 0, 0}, {-1, 0, 0}};
  EXPECT_TRUE(triangulation_arcs(ring({0, 1}), antipodal).empty());
  EXPECT_TRUE(triangulation_arcs(ring({0}), antipodal).empty());
  EXPECT_TRUE(triangulation_arcs(Triangulation{}, {}).empty());
}

TEST(triangulation_arcs, span_a_half_circle_of_sites_but_not_its_gap) {
  const std::vector<Point> sites{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  const auto arcs = undirected(triangulation_arcs(ring({0, 1, 2}), sites));
  const std::set<std::set<Index>> expected{{0, 1}, {1, 2}};
  EXPECT_EQ(arcs, expected);
}

TEST(cell_arcs, has_each_edge_once_and_none_of_length_zero) {
  Cells cells;
  cells.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
  cells.rings = {0, 1, 2, 3, 3, 2, 1, 0};
  cells.offsets = {0, 4, 4, 8};
  const auto arcs = cell_arcs(cells);
  const std::set<std::set<Index>> expected{{0, 1}, {1, 2}, {0, 3}};
  EXPECT_EQ(arcs.size(), 3U);
  EXPECT_EQ(undirected(arcs), expected);
}

TEST(median_spacing, is_that_of_the_nearest_sites_in_front) {
  const std::vector<Point> points{{0, 0, 1}, {0.1, 0, 0.99}, {0.4, 0, 0.9}, {0, 0, -1}};
  const std::vector<ArcEnds> arcs{{0, 1}, {0, 2}, {1, 2}, {0, 3}};
  EXPECT_DOUBLE_EQ(median_spacing(std::span(arcs).first(3), points), 0.1);
  EXPECT_EQ(median_spacing({}, points), 0);
}

}  // namespace
}  // namespace rondel::cli
