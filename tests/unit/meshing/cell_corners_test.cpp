// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CellCorners: the corners of a mesh's cells, of which some are in the same place.
//
//     3 -- 2    Edge 0 joins the vertices 0 and 1, and so on around the cell. Where an edge has length 0, its ends are one
//     |    |    corner, which has the number of the lowest vertex there.
//     0 -- 1
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include "formats/mesh_file.h"

namespace rondel::test::of_cell_corners {
namespace {

using formats::CellCorners;
using Corners = std::vector<Index>;

// A ring of vertices in this order, with the lengths of the edges from each to the next one.
mesh::VoronoiMesh one_cell(const Corners& ring, const std::vector<double>& lengths) {
  mesh::VoronoiMesh arrays;
  arrays.vertex_points.resize(8);
  arrays.edges_on_cell.offsets = {0, ring.size()};
  arrays.vertices_on_cell.assign(ring.begin(), ring.end());
  arrays.vertex_distances.assign(lengths.begin(), lengths.end());
  for (std::size_t i = 0; i < ring.size(); ++i)
    arrays.vertices_on_edge.push_back({ring[i], ring[(i + 1) % ring.size()]});
  arrays.edge_points.resize(ring.size());
  return arrays;
}

Corners corners_of(const mesh::VoronoiMesh& arrays, std::size_t cell = 0) {
  const CellCorners corners(arrays);
  Corners found;
  corners.visit(cell, [&](Index vertex) { found.push_back(vertex); });
  EXPECT_EQ(corners.count(cell), found.size());
  return found;
}

TEST(cell_corners, are_the_vertices_where_every_edge_has_a_length) {
  EXPECT_EQ(corners_of(one_cell({0, 1, 2, 3}, {1, 1, 1, 1})), (Corners{0, 1, 2, 3}));
  EXPECT_EQ(corners_of(one_cell({3, 1, 2, 0}, {1, 1, 1, 1})), (Corners{3, 1, 2, 0}));
}

TEST(cell_corners, the_ends_of_an_edge_of_length_0_are_one) {
  EXPECT_EQ(corners_of(one_cell({0, 1, 2, 3}, {1, 0, 1, 1})), (Corners{0, 1, 3}));
  EXPECT_EQ(corners_of(one_cell({3, 2, 1, 0}, {1, 0, 1, 1})), (Corners{3, 1, 0}));
  // Between the last vertex and the first one.
  EXPECT_EQ(corners_of(one_cell({0, 1, 2, 3}, {1, 1, 1, 0})), (Corners{1, 2, 0}));
}

// Three vertices in a row are in one place, also if the edges between them come in another order.
TEST(cell_corners, edges_of_length_0_in_a_row_leave_one_corner) {
  EXPECT_EQ(corners_of(one_cell({4, 7, 2, 5, 6}, {1, 0, 0, 1, 1})), (Corners{4, 2, 6}));
  EXPECT_EQ(corners_of(one_cell({7, 2, 5, 6, 4}, {0, 0, 1, 1, 1})), (Corners{2, 6, 4}));
  EXPECT_EQ(corners_of(one_cell({1, 3, 0, 2, 5, 4}, {0, 1, 0, 0, 1, 1})), (Corners{1, 0, 4}));
  EXPECT_EQ(corners_of(one_cell({1, 3, 0, 2}, {0, 0, 0, 0})), (Corners{}));
}

// Two triangles and two quadrilaterals, one of which has three corners; blocks are by number of corners, then by index.
TEST(cell_corners, group_cells_into_blocks) {
  mesh::VoronoiMesh arrays;
  arrays.vertex_points.resize(8);
  arrays.cell_points.resize(4);
  arrays.edges_on_cell.offsets = {0, 4, 7, 11, 14};
  arrays.edges_on_cell.values.resize(14);  // only how many each cell has matters here
  arrays.vertices_on_cell = {0, 1, 2, 3, 0, 1, 4, 4, 5, 6, 7, 5, 6, 2};
  arrays.vertices_on_edge = {{0, 1}, {5, 4}};
  arrays.vertex_distances = {1, 0};
  arrays.edge_points.resize(2);
  const CellCorners corners(arrays);
  EXPECT_EQ(corners_of(arrays, 2), (Corners{4, 6, 7}));
  const formats::CellBlocks blocks = formats::blocks_of(arrays, corners);
  EXPECT_EQ(blocks.cells, (std::vector<Index>{1, 2, 3, 0}));
  EXPECT_EQ(blocks.begins, (std::vector<std::size_t>{0, 3, 4}));
  EXPECT_EQ(blocks.corners, (std::vector<std::size_t>{3, 4}));
}

}  // namespace
}  // namespace rondel::test::of_cell_corners
