// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Leaving out sites that are certainly inside, and finding duplicates without an order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hidden/direction_grid.h"
#include "hidden/hidden_faces.h"
#include "hidden/inner_point.h"
#include "hidden/inner_sites.h"
#include "kernel/triangulate.h"
#include "order/spatial_order.h"
#include "predicates/orientation.h"
#include "rondel/delaunay.h"
#include "rondel/hull.h"
#include "support/generators.h"
#include "support/hull_check.h"
#include "support/random.h"

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

// The faces reported above hidden sites against a search through all faces by exact orientations,
// where many faces are seen in one direction.

Triangulation build(std::span<const Point> sites, const Point& center, unsigned threads = 1) {
  Options options;
  options.model = Model::weighted;
  options.sphere.center = center;
  return delaunay(sites, options, {.threads = threads});
}

Index first_face_above(const Triangulation& t, std::span<const Point> sites, Index site) {
  const auto is_in_front = [&](Index from, Index to) {
    return predicates::orientation(sites[from], sites[to], sites[site], t.sphere().center).sign !=
           Sign::negative;
  };
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto& [a, b, c] = t.faces()[f];
    if (!t.is_ghost(f) && is_in_front(a, b) && is_in_front(b, c) && is_in_front(c, a)) return f;
  }
  return no_index;
}

void expect_first_faces(std::span<const Point> sites, const Point& center, std::size_t min_hidden) {
  const Triangulation t = build(sites, center);
  ASSERT_GE(t.hidden().size(), min_hidden);
  for (const auto& [site, face] : t.hidden()) {
    ASSERT_EQ(face, first_face_above(t, sites, site)) << site;
  }
  const Triangulation again = build(sites, center, 4);
  EXPECT_TRUE(std::ranges::equal(t.hidden(), again.hidden()));
}

// Sites of a sphere so close together that rounding hides most.
std::vector<Point> patch(std::size_t n, const Point& center) {
  Random random(3);
  std::vector<Point> sites;
  for (const double s : {-1, 1}) {
    sites.insert(sites.end(), {{center.x + s, center.y, center.z},
                               {center.x, center.y + s, center.z},
                               {center.x, center.y, center.z + s}});
  }
  while (sites.size() < n) {
    const double a = 2e-7 * random.signed_unit();
    const double b = 2e-7 * random.signed_unit();
    const Point p = {0.6 - 0.8 * a, b, 0.8 + 0.6 * a};
    const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    sites.push_back({center.x + p.x / length, center.y + p.y / length, center.z + p.z / length});
  }
  return sites;
}

TEST(hidden_faces, are_the_first_ones_below_a_dense_patch) {
  expect_first_faces(patch(6000, {}), {}, 2000);
}

TEST(hidden_faces, are_the_first_ones_around_another_center) {
  const Point center = {0.25, -0.5, 0.125};
  expect_first_faces(patch(6000, center), center, 2000);
}

// The center is outside the hull: ghost faces, and rays that end at the contour.
TEST(hidden_faces, are_the_first_ones_where_the_center_is_outside) {
  auto sites = patch(6000, {});
  std::erase_if(sites, [](const Point& p) { return p.x <= 0 || p.z <= 0; });
  EXPECT_GT(build(sites, {}).num_ghost_faces(), 0U);
  expect_first_faces(sites, {}, 2000);
}

// Vertices of a bump that is 2^-33 wide, multiples of 2^-51 in z so that sums of two are
// exact.
std::vector<Point> bump(std::size_t n, Random& random) {
  std::vector<Point> sites = {{1, 1, -1}, {-1, 1, -1}, {0, -1, -1}};
  while (sites.size() < n) {
    const double u = random.signed_unit();
    const double v = random.signed_unit();
    const double z = 2 - 0x1p-34 * (u * u + v * v);
    sites.push_back({std::round(u * 0x1p20) * 0x1p-53, std::round(v * 0x1p20) * 0x1p-53,
                     std::round(z * 0x1p51) * 0x1p-51});
  }
  return sites;
}

// Closer than the spatial order's upper keys can tell; also on the rays of vertices and in the
// planes of edges. Few and many, which take different walks.
TEST(hidden_faces, are_the_first_ones_below_a_tiny_bump) {
  for (const int spread : {1, 40}) {
    Random random(7);
    auto sites = bump(2000, random);
    const Triangulation t = build(sites, {});
    const std::size_t vertices = t.num_vertices();
    ASSERT_GT(vertices, 1000U);
    for (Index f = 0; f < t.num_faces(); f += static_cast<Index>(spread)) {
      const auto& [i, j, k] = t.faces()[f];
      const auto& [a, b, c] = std::array<Point, 3>{sites[i], sites[j], sites[k]};
      sites.push_back({a.x / 2, a.y / 2, a.z / 2});
      sites.push_back({(a.x + b.x) / 4, (a.y + b.y) / 4, (a.z + b.z) / 4});
      const double s = 0.2 + 0.1 * random.unit();
      sites.push_back({(a.x + b.x + c.x) * s, (a.y + b.y + c.y) * s, (a.z + b.z + c.z) * s});
    }
    const Triangulation hiding = build(sites, {});
    ASSERT_EQ(hiding.num_vertices(), vertices);
    const std::size_t added = sites.size() - 2000;
    expect_first_faces(sites, {}, added / 2);
  }
}

// A vertex of high degree, in all directions of which sites are hidden.
TEST(hidden_faces, are_the_first_ones_around_a_vertex_of_high_degree) {
  Random random(5);
  std::vector<Point> sites = {{0, 0, 1.5}, {0, 0, -1}};
  constexpr int degree = 2000;
  for (int i = 0; i < degree; ++i) {
    const double angle = 2 * std::numbers::pi * i / degree;
    sites.push_back({std::cos(angle), std::sin(angle), 0.5});
  }
  for (int i = 0; i < 3000; ++i) {
    const double width = std::pow(10, -6 * random.unit());
    sites.push_back({0.3 * width * random.signed_unit(), 0.3 * width * random.signed_unit(), 0.5});
  }
  expect_first_faces(sites, {}, 3000);
}

}  // namespace
}  // namespace rondel::test
