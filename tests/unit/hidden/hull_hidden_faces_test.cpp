// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces reported above hidden sites against a search through all faces by exact orientations,
// where many faces are seen in one direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "predicates/orientation.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test {
namespace {

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

void expect_first_faces(std::span<const Point> sites, const Point& center,
                        std::size_t least_hidden) {
  const Triangulation t = build(sites, center);
  ASSERT_GE(t.hidden().size(), least_hidden);
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
