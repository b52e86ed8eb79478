// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The repair alone, of sites with one thing wrong.
#include "meshing/scvt_repair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/point_sets.h"

namespace rondel::mesh {
namespace {

using exact::to_point;
using exact::to_vector;

// Between 0.13 and 0.17 long are the edges of this icosahedral grid.
constexpr unsigned levels = 3;
constexpr double longest_edge = 0.17;

double farthest_move(const std::vector<Point>& before, const std::vector<Point>& after) {
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, norm(to_vector(before[i]) - to_vector(after[i])));
  }
  return most;
}

TEST(scvt_repair, an_obtuse_triangle_without_a_short_edge_is_made_acute) {
  std::vector<Point> sites = icosahedral_points(levels);
  const Triangulation triangulation = delaunay(sites);
  // A corner comes so near to the opposite edge that its angle is above 90 degrees.
  const Triple face = triangulation.faces()[100];
  const auto middle = 0.5 * (to_vector(sites[face[1]]) + to_vector(sites[face[2]]));
  const auto apex = to_vector(sites[face[0]]);
  sites[face[0]] = to_point(normalized(apex + 0.4 * (middle - apex)));
  const std::vector<Point> start = sites;
  const ScvtRepair done = repair(sites, {}, 1);
  EXPECT_EQ(done.before.short_edges, 0U);
  EXPECT_GT(done.before.obtuse_triangles, 0U);
  EXPECT_EQ(done.after.obtuse_triangles, 0U);
  EXPECT_GT(done.moved, 0U);
  EXPECT_LT(farthest_move(start, sites), 0.15 * longest_edge);
}

// Sites in the middle of triangles get three or four neighbors, which takes more to mend than is allowed.
TEST(scvt_repair, sites_move_no_farther_than_they_may) {
  std::vector<Point> sites = icosahedral_points(levels);
  const Triangulation triangulation = delaunay(sites);
  for (std::size_t f = 0; f < triangulation.num_faces(); f += 60) {
    const Triple face = triangulation.faces()[f];
    sites.push_back(to_point(normalized(1.01 * to_vector(sites[face[0]]) +
                                        to_vector(sites[face[1]]) + to_vector(sites[face[2]]))));
  }
  const std::vector<Point> start = sites;
  const ScvtRepair done = repair(sites, {}, 1);
  EXPECT_GT(done.before.odd_cells, 10U);
  EXPECT_LE(done.after.odd_cells, done.before.odd_cells);
  EXPECT_LT(farthest_move(start, sites), 0.15 * 1.3 * longest_edge);
}

}  // namespace
}  // namespace rondel::mesh
