// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/face_batch.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "dual/face_normal.h"
#include "unit/dual/support.h"

namespace rondel::test {
namespace {

// A batch gives the same bits as a face alone, wherever in it the face is.
TEST(dual_normals, are_the_same_in_batches_and_alone) {
  for_each_case(100, 1, [](const DualCase& c) {
    if (c.triangulation.dimension() < 2) return;
    const dual::SplitSites sites(c.triangulation, 1);
    const auto centers = circumcenters(c.triangulation);
    for (Index f = 0; f < centers.size(); ++f) {
      const auto [i, j, k] = sites.corners(f);
      EXPECT_EQ(centers[f], dual::unit_normal(sites, i, j, k)) << c.name << " face " << f;
    }
  });
}

TEST(kites, are_left_out_where_an_area_is_large) {
  const std::vector<Point> sites = octahedron();
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, 1);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  // A corner of the octant is 54.7 degrees from its middle, but the tangent is above 1/16.
  EXPECT_TRUE(dual::unit_normals(split_sites, 0, points, kites.data()));
  for (const dual::Kites& k : kites) EXPECT_TRUE(dual::is_careful(k));
}

TEST(kites, of_all_faces_add_up_to_the_sphere) {
  const auto sites = generator("uniform").make(500, 3).sites;
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, 1);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  EXPECT_FALSE(dual::unit_normals(split_sites, 0, points, kites.data()));
  double sum = 0;
  for (const dual::Kites& k : kites) sum += k[0] + k[1] + k[2];
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-13);
}

}  // namespace
}  // namespace rondel::test
