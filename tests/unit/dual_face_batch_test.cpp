// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "dual/face_batch.h"
#include "dual/face_normal.h"
#include "unit/dual_support.h"

namespace rondel::test {
namespace {

double distance(double hi, double lo, double other_hi, double other_lo) {
  return std::abs((hi - other_hi) + (lo - other_lo));
}

// Both are within 2^-100 of the truth.
void expect_unit_vectors(const std::vector<Point>& sites, const Point& center) {
  std::vector<Index> order(sites.size());
  std::iota(order.rbegin(), order.rend(), Index{0});
  std::vector<exact::SplitPoint> places(sites.size());
  dual::unit_vectors(sites, center, order, places.data());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const exact::SplitPoint& p = places[k];
    const exact::SplitPoint q = exact::unit_vector(sites[order[k]], center);
    EXPECT_LE(distance(p.hi.x, p.lo.x, q.hi.x, q.lo.x), 0x1p-99) << k;
    EXPECT_LE(distance(p.hi.y, p.lo.y, q.hi.y, q.lo.y), 0x1p-99) << k;
    EXPECT_LE(distance(p.hi.z, p.lo.z, q.hi.z, q.lo.z), 0x1p-99) << k;
    EXPECT_LE(std::abs(p.hi.x - q.hi.x), 0x1p-53) << k;
  }
}

TEST(dual_places, are_as_precise_as_those_of_single_points) {
  for (const char* name : {"uniform", "patch_1e_9", "near_sphere", "mixed_scales", "s_n"}) {
    expect_unit_vectors(generator(name).make(700, 1).sites, {});
    expect_unit_vectors(generator(name).make(65, 2).sites, {1e-3, 7, -0.1});
  }
}

TEST(dual_places, hold_where_squares_would_leave_the_range) {
  std::vector<Point> sites;
  for (int exponent = -1070; exponent < 1020; exponent += 10) {
    sites.push_back({std::ldexp(1.25, exponent), std::ldexp(-0.75, exponent), 0});
  }
  expect_unit_vectors(sites, {});
}

// A batch gives the same bits as a face alone, wherever in it the face is.
TEST(dual_normals, are_the_same_in_batches_and_alone) {
  for_each_case(100, 1, [](const DualCase& c) {
    if (c.triangulation.dimension() < 2) return;
    const dual::SplitSites sites(c.triangulation, c.sites);
    const auto centers = circumcenters(c.triangulation, c.sites);
    for (Index f = 0; f < centers.size(); ++f) {
      const auto [i, j, k] = sites.corners(f);
      EXPECT_EQ(centers[f], dual::unit_normal(sites, i, j, k)) << c.name << " face " << f;
    }
  });
}

TEST(kites, are_left_out_where_an_area_is_large) {
  const std::vector<Point> sites = octahedron();
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, sites);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  // A corner of the octant is 54.7 degrees from its middle, but the tangent is above 1/16.
  EXPECT_TRUE(dual::unit_normals(split_sites, 0, points, kites.data()));
  for (const dual::Kites& k : kites) EXPECT_TRUE(dual::is_careful(k));
}

TEST(kites, of_all_faces_add_up_to_the_sphere) {
  const auto sites = generator("uniform").make(500, 3).sites;
  const Triangulation t = triangulated(sites);
  const dual::SplitSites split_sites(t, sites);
  std::vector<Point> points(t.num_faces());
  std::vector<dual::Kites> kites(t.num_faces());
  EXPECT_FALSE(dual::unit_normals(split_sites, 0, points, kites.data()));
  double sum = 0;
  for (const dual::Kites& k : kites) sum += k[0] + k[1] + k[2];
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-13);
}

}  // namespace
}  // namespace rondel::test
