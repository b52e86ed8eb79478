// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles that fill polygons: their areas, their borders, and what is refused.
#include "rondel/polygon_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"

namespace rondel::test::of_polygon_triangles {
namespace {

void append_ring(CellRings& polygons, const std::vector<LonLat>& places) {
  for (const Point& point : unit_vectors(places)) {
    polygons.corners.push_back(static_cast<Index>(polygons.points.size()));
    polygons.points.push_back(point);
  }
  polygons.end_ring();
}

CellRings polygon_of(const std::vector<std::vector<LonLat>>& rings) {
  CellRings made;
  for (const auto& ring : rings) append_ring(made, ring);
  made.end_cell();
  return made;
}

// The solid angle of a triangle (Oosterom and Strackee 1983).
double solid_angle(const Point& a, const Point& b, const Point& c) {
  const auto dot = [](const Point& p, const Point& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
  const Point normal = {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x};
  return 2 * std::atan2(dot(a, normal), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

double area_of(const PolygonTriangles& made, std::size_t polygon) {
  double sum = 0;
  for (const auto& [a, b, c] : made.triangles[polygon]) {
    EXPECT_EQ(orientation(made.points[a], made.points[b], made.points[c]), Sign::positive);
    sum += solid_angle(made.points[a], made.points[b], made.points[c]);
  }
  return sum;
}

// The number of sides that belong to one triangle of a polygon alone.
std::size_t num_border_sides(const PolygonTriangles& made, std::size_t polygon) {
  std::set<std::array<Index, 2>> sides;
  for (const Triple& t : made.triangles[polygon]) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(sides.insert({t[i], t[(i + 1) % 3]}).second);
    }
  }
  return static_cast<std::size_t>(std::ranges::count_if(sides, [&](const auto& side) {
    return !sides.contains({side[1], side[0]});
  }));
}

const std::vector<LonLat> square = {{0, 0}, {40, 0}, {40, 40}, {0, 40}};
const std::vector<LonLat> hole = {{10, 10}, {10, 20}, {20, 20}, {20, 10}};

void expect_filled(const CellRings& polygons, std::size_t num_sides) {
  const double expected = areas(polygons)[0];
  for (const double spacing : {0.0, 7.0, 400.0}) {
    const PolygonTriangles made = triangles_of_polygons(polygons, spacing);
    ASSERT_EQ(made.triangles.size(), 1U);
    EXPECT_NEAR(area_of(made, 0), expected, 1e-12) << spacing;
    if (spacing != 7) {
      EXPECT_EQ(num_border_sides(made, 0), num_sides);
    }
    std::vector<bool> is_used(made.points.size());
    for (const Triple& t : made.triangles.values) {
      for (const Index corner : t) is_used[corner] = true;
    }
    EXPECT_EQ(std::ranges::count(is_used, false), 0);
    const PolygonTriangles again = triangles_of_polygons(polygons, spacing, {.threads = 1});
    EXPECT_EQ(again.triangles, made.triangles);
    EXPECT_EQ(again.points, made.points);
  }
}

TEST(polygon_triangles, polygons_with_holes_and_what_is_around_them) {
  expect_filled(polygon_of({square, hole}), 8);
  std::vector<LonLat> outside = square;
  std::ranges::reverse(outside);
  expect_filled(polygon_of({outside}), 4);
}

TEST(polygon_triangles, poles_the_antimeridian_and_a_hemisphere) {
  expect_filled(polygon_of({{{0, 80}, {120, 80}, {-120, 80}}}), 3);
  expect_filled(polygon_of({{{170, -10}, {-170, -10}, {-170, 10}, {170, 10}}}), 4);
  expect_filled(polygon_of({{{0, 0}, {90, 0}, {180, 0}, {-90, 0}}}), 4);
  expect_filled(polygon_of({{{0, -80}, {120, -80}, {-120, -80}}}), 3);
  // A polygon without an end of its own within a plane: a lune of 179 degrees.
  expect_filled(polygon_of({{{0, -90}, {0, 0}, {0, 90}, {-179, 0}}}), 4);
}

TEST(polygon_triangles, the_whole_sphere_and_nothing) {
  CellRings polygons = polygon_of({square});
  polygons.end_cell();
  polygons.whole = {2};
  polygons.end_cell();
  for (const double spacing : {0.0, 9.0}) {
    const PolygonTriangles made = triangles_of_polygons(polygons, spacing);
    EXPECT_NEAR(area_of(made, 2), 4 * std::numbers::pi, 1e-12);
    EXPECT_EQ(made.triangles[1].size(), 0U);
    EXPECT_NEAR(area_of(made, 0), areas(polygons)[0], 1e-12);
  }
  EXPECT_TRUE(triangles_of_polygons({}).points.empty());
  EXPECT_TRUE(triangles_of_polygons({}, 5).points.empty());
  CellRings sphere;
  sphere.whole = {0};
  sphere.end_cell();
  EXPECT_EQ(triangles_of_polygons(sphere).triangles[0].size(), 8U);
}

TEST(polygon_triangles, neighbors_share_edges_and_overlaps_are_divided) {
  CellRings polygons = polygon_of({square});
  append_ring(polygons, {{40, 0}, {80, 0}, {80, 40}, {40, 40}});
  polygons.end_cell();
  append_ring(polygons, {{20, 20}, {60, 20}, {60, 60}, {20, 60}});
  polygons.end_cell();
  const std::vector<double> expected = areas(polygons);
  for (const double spacing : {0.0, 3.0}) {
    const PolygonTriangles made = triangles_of_polygons(polygons, spacing);
    for (std::size_t p = 0; p < 3; ++p) EXPECT_NEAR(area_of(made, p), expected[p], 1e-12);
    for (std::size_t i = 0; i < made.points.size(); ++i) {
      EXPECT_EQ(std::ranges::count(made.points, made.points[i]), 1);
    }
  }
}

// Polygons may share points, or have equal ones each; some points are no corners.
TEST(polygon_triangles, points_may_be_shared_or_repeated) {
  CellRings apart = polygon_of({square, {{10, 10}, {10, 20}, {20, 20}, {20, 10}}});
  append_ring(apart, {{40, 0}, {80, 0}, {80, 40}, {40, 40}});
  apart.end_cell();
  append_ring(apart, {{10, 10}, {20, 10}, {20, 20}, {10, 20}});
  apart.end_cell();
  CellRings shared = apart;
  shared.points.assign(1, {0, 0, -1});
  for (Index& corner : shared.corners) {
    const Point& point = apart.points[corner];
    const auto known = std::ranges::find(shared.points, point);
    corner = static_cast<Index>(known - shared.points.begin());
    if (known == shared.points.end()) shared.points.push_back(point);
  }
  ASSERT_LT(shared.points.size(), shared.corners.size());
  // One corner has a point of its own again, which is in the place of another one.
  CellRings repeated = shared;
  repeated.points.push_back(repeated.points[repeated.corners.back()]);
  repeated.corners.back() = static_cast<Index>(repeated.points.size() - 1);
  const PolygonTriangles expected = triangles_of_polygons(apart);
  for (const CellRings& polygons : {shared, repeated}) {
    const PolygonTriangles made = triangles_of_polygons(polygons);
    EXPECT_EQ(made.points, expected.points);
    EXPECT_EQ(made.triangles.offsets, expected.triangles.offsets);
    EXPECT_EQ(made.triangles.values, expected.triangles.values);
  }
  EXPECT_EQ(expected.triangles.size(), 3U);
  EXPECT_EQ(expected.triangles[2].size(), 2U);
}

TEST(polygon_triangles, a_spacing_bounds_sides) {
  const CellRings polygons = polygon_of({{{0, 40}, {60, 40}, {60, 80}, {0, 80}}});
  const PolygonTriangles made = triangles_of_polygons(polygons, 4);
  double longest = 0;
  for (const Triple& t : made.triangles.values) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = made.points[t[i]];
      const Point& q = made.points[t[(i + 1) % 3]];
      longest = std::max(longest, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
    }
  }
  EXPECT_LT(longest * 180 / std::numbers::pi, 8);
  EXPECT_GT(made.triangles.values.size(), 100U);
}

std::size_t refused_index(const CellRings& polygons, double spacing = 0) {
  try {
    triangles_of_polygons(polygons, spacing);
  } catch (const InvalidInput& error) {
    return error.index();
  }
  return 1000;
}

TEST(polygon_triangles, what_is_refused) {
  const CellRings good = polygon_of({square});
  for (const double spacing : {-1.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 1e-9, 1e-320}) {
    EXPECT_EQ(refused_index(good, spacing), InvalidInput::no_index) << spacing;
  }
  CellRings crossing = good;
  append_ring(crossing, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  crossing.end_cell();
  EXPECT_EQ(refused_index(crossing), 1U);
  CellRings wild = good;
  wild.corners.back() = 99;
  EXPECT_EQ(refused_index(wild), InvalidInput::no_index);
  CellRings infinite = good;
  infinite.points.back().z = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused_index(infinite), 0U);
}

}  // namespace
}  // namespace rondel::test::of_polygon_triangles
