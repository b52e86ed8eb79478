// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Leaving out sites that are certainly inside, and finding duplicates without an order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hidden/direction_grid.h"
#include "hidden/hidden_faces.h"
#include "hidden/inner_point.h"
#include "hidden/inner_sites.h"
#include "kernel/triangulate.h"
#include "order/duplicates.h"
#include "order/spatial_order.h"
#include "rondel/delaunay.h"
#include "rondel/hull.h"
#include "support/generators.h"
#include "support/hull_check.h"

namespace rondel::test {
namespace {

// The kernel alone: every site is inserted.
TriangulationArrays insert_all(std::span<const Point> sites, const Point& center) {
  system::Job options;
  options.model = Model::weighted;
  options.sphere.center = center;
  auto order = order::spatial_order(sites, options.model, center, options.threads);
  auto arrays = kernel::triangulate(sites, std::move(order.order), order.renamed, options).arrays;
  arrays.num_sites = sites.size();
  arrays.duplicates = std::move(order.duplicates);
  hidden::assign_hidden_faces(sites, center, arrays, options.threads);
  return arrays;
}

void expect_equal(const Triangulation& t, const TriangulationArrays& arrays) {
  EXPECT_TRUE(std::ranges::equal(t.faces(), arrays.faces));
  EXPECT_TRUE(std::ranges::equal(t.neighbors(), arrays.neighbors));
  EXPECT_TRUE(std::ranges::equal(t.ghost_faces(), arrays.ghost_faces));
  EXPECT_TRUE(std::ranges::equal(t.duplicates(), arrays.duplicates));
  EXPECT_TRUE(std::ranges::equal(t.hidden(), arrays.hidden));
}

class inner_sites : public testing::TestWithParam<Cloud> {};

TEST_P(inner_sites, change_nothing_when_left_out) {
  const auto points = GetParam().make(20000, 5);
  const Triangulation hull = convex_hull(points);
  expect_equal(hull, insert_all(points, hull.sphere().center));
}

// A center that is not inside the hull: ghost faces, and walks that end at the contour.
TEST_P(inner_sites, change_nothing_around_another_center) {
  const auto points = GetParam().make(20000, 6);
  Options options;
  options.model = Model::weighted;
  options.sphere.center = {points[0].x + 3.5, points[0].y, points[0].z};
  expect_equal(delaunay(points, options), insert_all(points, options.sphere.center));
}

INSTANTIATE_TEST_SUITE_P(clouds, inner_sites,
                         testing::ValuesIn(solid_clouds().begin(), solid_clouds().end()),
                         [](const auto& cloud) { return std::string(cloud.param.name); });

TEST(inner_site, is_most_of_a_ball) {
  const auto points = solid_clouds()[0].make(100000, 1);
  const auto inner = hidden::find_inner_point(points);
  ASSERT_TRUE(inner.is_inside);
  EXPECT_TRUE(hidden::has_many_inner_sites(points, inner.point));
  EXPECT_LT(hidden::rest_without_inner_sites(points, inner).size(), points.size() / 8);
}

TEST(inner_site, is_none_on_a_sphere) {
  const SiteSet set = generator("uniform").make(20000, 1);
  const auto inner = hidden::find_inner_point(set.sites);
  EXPECT_FALSE(hidden::has_many_inner_sites(set.sites, inner.point));
}

// What is nearly on the boundary must be kept: sites in the facets of a cube, some moved in or out
// by one ulp.
TEST(inner_site, is_no_site_of_a_facet) {
  Random random(4);
  auto points = solid_clouds()[1].make(20000, 1);
  const std::size_t first = points.size();
  for (int i = 0; i < 2000; ++i) {
    Point p = {random.signed_unit(), random.signed_unit(), 1};
    if (i % 4 == 1) p.z = std::nextafter(1.0, 2.0);
    points.push_back(i % 2 == 0 ? p : Point{p.z, p.x, p.y});
  }
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) points.insert(points.end(), {{x, y, -1}, {x, y, 1}});
  }
  const auto inner = hidden::find_inner_point(points);
  ASSERT_TRUE(inner.is_inside);
  const auto rest = hidden::rest_without_inner_sites(points, inner);
  for (std::size_t i = first; i < points.size(); ++i) {
    ASSERT_TRUE(std::ranges::binary_search(rest, static_cast<Index>(i))) << i;
  }
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull_error(hull, points), "");
}

TEST(duplicates, are_found_without_an_order) {
  Random random(9);
  std::vector<Point> points;
  std::vector<Index> listed;
  for (Index i = 0; i < 5000; ++i) {
    const double zero = random.coin() ? 0.0 : -0.0;
    points.push_back({double(random.between(-5, 5)), double(random.between(-5, 5)), zero});
    if (random.below(5) != 0) listed.push_back(i);
  }
  std::vector<Duplicate> expected;
  for (const Index i : listed) {
    const auto lowest =
        std::ranges::find_if(listed, [&](Index j) { return points[j] == points[i]; });
    if (*lowest != i) expected.push_back({i, *lowest});
  }
  EXPECT_EQ(order::find_duplicates(points, listed), expected);
  EXPECT_TRUE(order::find_duplicates(points, {}).empty());
}

// One that is too short to be divided by has no place in the grid.
TEST(direction_grid, knows_the_place_of_each_direction_that_it_gives) {
  const hidden::DirectionGrid grid(8);
  for (const double length : {1e-320, 1e-310, 1e-300, 1e-280, 1.0, 1e300}) {
    const hidden::Direction d = grid.direction({0, length, 0});
    if (!(d.length > 0)) continue;
    EXPECT_EQ(d.u, 4) << length;
    EXPECT_EQ(d.v, 4) << length;
  }
  EXPECT_GT(grid.direction({0, 1e-280, 0}).length, 0);
  EXPECT_EQ(grid.direction({0, 1e-320, 0}).length, 0);
}

TEST(direction_grid, hidden_sites_may_be_close_to_the_center) {
  Options options;
  options.model = Model::weighted;
  const Triangulation built = delaunay(
      std::vector<Point>{
          {1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1e-320, 0, 0}, {0, -3e-310, 1e-320}},
      options);
  ASSERT_EQ(built.hidden().size(), 2U);
  for (const auto& [site, face] : built.hidden()) {
    const Triple& corners = built.faces()[face];
    const Index opposite = 6 - corners[0] - corners[1] - corners[2];
    EXPECT_TRUE(site == 4 ? opposite == 1 || opposite == 2 : opposite == 0 || opposite == 2);
  }
}

}  // namespace
}  // namespace rondel::test
