// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

#include "unit/map/cells_planar.h"

namespace rondel::test {
namespace {

using std::numbers::pi;

Point at(double lon_deg, double lat_deg) {
  const double lon = lon_deg * pi / 180;
  const double lat = lat_deg * pi / 180;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

std::vector<map::LonLatPolygon> lonlat_polygons(const std::vector<Point>& ring,
                                                double tolerance_deg) {
  return map::lonlat_polygons(ring, std::vector<double>(ring.size(), tolerance_deg));
}

constexpr Point north{0, 0, 1};
constexpr Point south{0, 0, -1};
constexpr Point front{1, 0, 0};
constexpr Point back{-1, 0, 0};
constexpr Point east{0, 1, 0};
constexpr Point west{0, -1, 0};

// The area to the left of a convex ring: the fan of triangles from its first point (van Oosterom
// and Strackee 1983).
double fan_area(const std::vector<Point>& ring) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Point& a = ring[0];
    const Point u = ring[i] - a;
    const Point v = ring[i + 1] - a;
    const double divisor = 1 + dot(a, ring[i]) + dot(ring[i], ring[i + 1]) + dot(ring[i + 1], a);
    area += 2 * std::atan2(dot(a, cross(u, v)), divisor);
  }
  return area;
}

TEST(lonlat_polygon, whole_sphere_is_the_rectangle) {
  const auto polygons = lonlat_polygons({}, 0.01);
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_EQ(fault(polygons), "");
  EXPECT_EQ(planar_area(polygons), 360 * 180);
}

TEST(lonlat_polygon, octahedron_has_eight_rectangles) {
  double total = 0;
  const std::array<Point, 4> belt{front, east, back, west};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const Point& pole : {north, south}) {
      std::vector<Point> ring{belt[i], belt[(i + 1) % 4], pole};
      if (pole == south) std::swap(ring[0], ring[1]);
      const auto polygons = lonlat_polygons(ring, 0.01);
      ASSERT_EQ(polygons.size(), 1U);
      EXPECT_EQ(fault(polygons), "");
      EXPECT_EQ(polygons[0].ring.size(), 5U);
      EXPECT_EQ(planar_area(polygons), 90 * 90);
      total += planar_area(polygons);
    }
  }
  EXPECT_EQ(total, 360 * 180);
}

TEST(lonlat_polygon, hemispheres_of_the_axes) {
  const std::array<std::vector<Point>, 6> rings{{{front, east, back, west},
                                                 {west, back, east, front},
                                                 {north, west, south, east},
                                                 {north, east, south, west},
                                                 {north, front, south, back},
                                                 {north, back, south, front}}};
  for (const auto& ring : rings) {
    const auto polygons = lonlat_polygons(ring, 0.01);
    EXPECT_EQ(fault(polygons), "");
    EXPECT_EQ(planar_area(polygons), 180 * 180);
  }
  EXPECT_TRUE(contains(lonlat_polygons(rings[2], 0.01), {10, 10}));
  EXPECT_EQ(lonlat_polygons(rings[3], 0.01).size(), 2U);
  EXPECT_TRUE(contains(lonlat_polygons(rings[3], 0.01), {-170, 10}));
  EXPECT_TRUE(contains(lonlat_polygons(rings[4], 0.01), {90, 10}));
  EXPECT_TRUE(contains(lonlat_polygons(rings[5], 0.01), {-90, 10}));
}

// Hemispheres bounded by a meridian circle whose points are rounded, at any longitude.
TEST(lonlat_polygon, hemispheres_of_any_meridian) {
  for (int lon = -180; lon < 180; ++lon) {
    std::vector<Point> ring;
    for (const int lat : {-80, -20, 40, 100, 160, 220}) {
      const double height = lat * pi / 180;
      const double angle = lon * pi / 180;
      ring.push_back({std::cos(height) * std::cos(angle), std::cos(height) * std::sin(angle),
                      std::sin(height)});
    }
    const auto polygons = lonlat_polygons(ring, 0.01);
    EXPECT_EQ(fault(polygons), "") << lon;
    EXPECT_NEAR(planar_area(polygons), 180 * 180, 1e-9) << lon;
    EXPECT_TRUE(contains(polygons, {lon < -120 ? lon + 300.5 : lon - 59.5, 1})) << lon;
  }
}

TEST(lonlat_polygon, lunes_from_pole_to_pole) {
  for (int lon = -180; lon < 180; lon += 15) {
    for (const int width : {1, 15, 90, 165, 180}) {
      const std::vector<Point> ring{north, at(lon, 0), south, at(lon + width, 0)};
      const auto polygons = lonlat_polygons(ring, 0.01);
      EXPECT_EQ(fault(polygons), "") << lon << ' ' << width;
      EXPECT_NEAR(planar_area(polygons), width * 180.0, 1e-9) << lon << ' ' << width;
      EXPECT_LE(polygons.size(), 2U);
    }
  }
}

TEST(lonlat_polygon, polar_caps_reach_the_pole) {
  for (const bool is_north : {true, false}) {
    std::vector<Point> ring;
    for (int lon = -170; lon < 180; lon += 20) ring.push_back(at(lon, is_north ? 60 : -60));
    if (!is_north) std::reverse(ring.begin(), ring.end());
    const auto polygons = lonlat_polygons(ring, 0.001);
    ASSERT_EQ(polygons.size(), 1U);
    EXPECT_EQ(fault(polygons), "");
    for (const double lon : {-180.0, 180.0}) {
      EXPECT_EQ(std::ranges::count(polygons[0].ring, LonLat{lon, is_north ? 90.0 : -90.0}), 1);
    }
    EXPECT_NEAR(spherical_area(polygons), fan_area(ring), 5e-5);
  }
}

TEST(lonlat_polygon, arc_through_the_pole_reaches_it) {
  const std::vector<Point> before{at(30, 60), at(-150, 70), at(-60, 50)};
  const std::vector<Point> behind{at(-150, 70), at(30, 60), at(120, 50)};
  for (const auto& ring : {before, behind}) {
    const auto polygons = lonlat_polygons(ring, 0.001);
    EXPECT_EQ(fault(polygons), "");
    EXPECT_NEAR(spherical_area(polygons), fan_area(ring), 5e-5);
    EXPECT_TRUE(contains(polygons, {ring == behind ? 31.0 : 29.0, 89.9999}));
    EXPECT_EQ(std::ranges::max(polygons[0].ring, {}, &LonLat::lat_deg).lat_deg, 90);
    EXPECT_EQ(polygons.size(), ring == behind ? 2U : 1U);  // the antimeridian ends in this one
  }
}

// A vertex at longitude 180, and an edge along it: nothing is cut, nothing lies at -180.
TEST(lonlat_polygon, touches_the_antimeridian_without_a_cut) {
  const Point low{-std::cos(0.1), 0, std::sin(0.1)};
  const Point high{-std::cos(0.3), -0.0, std::sin(0.3)};
  const auto from_west = lonlat_polygons(std::vector<Point>{low, high, at(170, 10)}, 0.01);
  ASSERT_EQ(from_west.size(), 1U);
  EXPECT_EQ(fault(from_west), "");
  EXPECT_TRUE(std::ranges::all_of(from_west[0].ring, [](LonLat p) { return p.lon_deg > 0; }));
  const auto from_east = lonlat_polygons(std::vector<Point>{high, low, at(-170, 10)}, 0.01);
  ASSERT_EQ(from_east.size(), 1U);
  EXPECT_EQ(fault(from_east), "");
  EXPECT_TRUE(std::ranges::all_of(from_east[0].ring, [](LonLat p) { return p.lon_deg < 0; }));
  const auto across =
      lonlat_polygons(std::vector<Point>{low, at(-170, 12), high, at(170, 12)}, 0.01);
  ASSERT_EQ(across.size(), 2U);
  EXPECT_EQ(fault(across), "");
}

// Convex rings: points on a small circle around any center, of any size.
std::vector<Point> ring_around(const Point& center, double radius, int count,
                               std::mt19937_64& random) {
  const Point helper = std::abs(center.z) < 0.5 ? Point{0, 0, 1} : Point{1, 0, 0};
  const Point u = normalized(cross(helper, center));
  const Point v = cross(center, u);
  std::vector<Point> ring;
  for (int i = 0; i < count; ++i) {
    const double jitter = std::uniform_real_distribution<double>(0, 0.8)(random);
    const double angle = 2 * pi * (i + jitter) / count;
    const double a = std::sin(radius) * std::cos(angle);
    const double b = std::sin(radius) * std::sin(angle);
    const double c = std::cos(radius);
    ring.push_back(
        normalized(Point{a * u.x + b * v.x + c * center.x, a * u.y + b * v.y + c * center.y,
                         a * u.z + b * v.z + c * center.z}));
  }
  return ring;
}

TEST(lonlat_polygon, random_convex_rings_keep_their_area) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::array<double, 6> radii{1e-9, 1e-6, 1e-3, 0.1, 0.7, 1.5};
  for (int trial = 0; trial < 6000; ++trial) {
    const double radius = radii[static_cast<std::size_t>(trial) % radii.size()];
    const double offset = radius * (2 * unit(random) - 1);  // so that the boundary passes nearby
    Point center = at(360 * unit(random), std::asin(2 * unit(random) - 1) * 180 / pi);
    if (trial / 6 % 3 == 1) center = at(180 + offset * 180 / pi, 170 * unit(random) - 85);
    if (trial / 6 % 3 == 2)
      center = at(360 * unit(random), (trial % 2 == 0 ? 90 : -90) - offset * 180 / pi);
    const auto ring = ring_around(center, radius, 4 + trial % 5, random);
    const auto polygons = lonlat_polygons(ring, std::min(0.01, radius));
    ASSERT_FALSE(polygons.empty());
    EXPECT_EQ(fault(polygons), "") << trial;
    const double area = fan_area(ring);
    const double tolerance = std::min(0.01, radius) * pi / 180 * 8 * radius + 1e-15 * radius;
    EXPECT_NEAR(spherical_area(polygons), area, tolerance) << trial;
    EXPECT_LE(polygons.size(), 3U);
  }
}

// Property 3: both triangles at an arc list the same positions along it.
TEST(lonlat_polygon, neighbors_share_their_positions) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const auto point = [&] {
      return normalized(Point{unit(random) - 1.2, unit(random), unit(random)});
    };
    std::array<Point, 4> p{point(), point(), point(), point()};
    const auto orientation = [](const Point& a, const Point& b, const Point& c) {
      return dot(a, cross(b - a, c - a));
    };
    if (orientation(p[0], p[1], p[2]) < 0) std::swap(p[0], p[1]);
    if (orientation(p[1], p[0], p[3]) <= 0) continue;
    const auto positions = [](const std::vector<Point>& ring) {
      std::set<std::pair<double, double>> all;
      for (const auto& polygon : lonlat_polygons(ring, 0.1)) {
        for (const LonLat& at : polygon.ring) all.insert({at.lon_deg, at.lat_deg});
      }
      return all;
    };
    const auto left = positions({p[0], p[1], p[2]});
    const auto right = positions({p[1], p[0], p[3]});
    const Point normal = normalized(cross(p[0], p[1]));
    for (const auto& [lon, lat] : left) {
      const Point q = at(lon, lat);
      const bool is_inside = dot(q, p[0] + p[1]) > 1 + dot(p[0], p[1]) - 1e-12;
      if (std::abs(dot(q, normal)) > 1e-14 || !is_inside) continue;
      EXPECT_TRUE(right.contains({lon, lat})) << trial << ": " << lon << ' ' << lat;
    }
  }
}

TEST(lonlat_polygon, fewer_than_three_points_have_no_polygon) {
  const Point near_pole{1e-15, 1e-15, 1};
  EXPECT_TRUE(lonlat_polygons(std::vector<Point>{front, front, east, east}, 0.01).empty());
  EXPECT_TRUE(lonlat_polygons(std::vector<Point>{front, north, near_pole}, 0.01).empty());
}

}  // namespace
}  // namespace rondel::test
