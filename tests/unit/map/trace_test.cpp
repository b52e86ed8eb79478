// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Chains of rings and lines at the antimeridian and the poles, and points of arcs.
#include "map/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "map/arc.h"
#include "map/ring_area.h"
#include "map/shared_lines.h"
#include "support/random.h"

namespace rondel::test::of_trace {
namespace {

constexpr double radian = std::numbers::pi / 180;

Point on_sphere(double lon_deg, double lat_deg) {
  if (std::abs(lat_deg) == 90) return {0, 0, lat_deg / 90};
  if (std::abs(lon_deg) == 180) return {-std::cos(lat_deg * radian), 0, std::sin(lat_deg * radian)};
  return {std::cos(lat_deg * radian) * std::cos(lon_deg * radian),
          std::cos(lat_deg * radian) * std::sin(lon_deg * radian), std::sin(lat_deg * radian)};
}

// Draws a ring with a tolerance that needs no points between.
map::Trace traced(const std::vector<LonLat>& corners) {
  std::vector<Point> ring;
  for (const LonLat& p : corners) ring.push_back(on_sphere(p.lon_deg, p.lat_deg));
  map::Trace trace;
  map::draw(ring, std::vector<map::ArcTolerance>(ring.size(), {4, 4, {}}), trace);
  return trace;
}

void expect_positions(const map::Trace& trace, const std::vector<LonLat>& expected) {
  ASSERT_EQ(trace.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(trace.points[i].position.lon_deg, expected[i].lon_deg, 1e-11) << i;
    EXPECT_NEAR(trace.points[i].position.lat_deg, expected[i].lat_deg, 1e-11) << i;
  }
}

using Starts = std::vector<std::size_t>;
using Arcs = std::vector<std::uint32_t>;

// The latitude at the antimeridian of an arc between positions of one latitude, `away` degrees from it.
double latitude_at_antimeridian(double lat_deg, double away_deg) {
  return std::atan(std::tan(lat_deg * radian) / std::cos(away_deg * radian)) / radian;
}

TEST(trace, ring_around_a_pole_is_one_chain) {
  const double lat = latitude_at_antimeridian(60, 45);
  const map::Trace north = traced({{45, 60}, {135, 60}, {-135, 60}, {-45, 60}});
  expect_positions(north, {{-180, lat}, {-135, 60}, {-45, 60}, {45, 60}, {135, 60}, {180, lat}});
  EXPECT_EQ(north.starts, Starts{0});
  EXPECT_EQ(north.arcs, (Arcs{1, 2, 3, 0, 1, 1}));
  EXPECT_TRUE(north.has_north_corners);
  const map::Trace south = traced({{45, -60}, {-45, -60}, {-135, -60}, {135, -60}});
  expect_positions(south,
                   {{180, -lat}, {135, -60}, {45, -60}, {-45, -60}, {-135, -60}, {-180, -lat}});
  EXPECT_EQ(south.starts, Starts{0});
  EXPECT_FALSE(south.has_north_corners);
}

TEST(trace, ring_across_the_antimeridian_is_two_chains) {
  const double lat = latitude_at_antimeridian(10, 10);
  const map::Trace trace = traced({{170, -10}, {-170, -10}, {-170, 10}, {170, 10}});
  expect_positions(trace, {{-180, -lat},
                           {-170, -10},
                           {-170, 10},
                           {-180, lat},
                           {180, lat},
                           {170, 10},
                           {170, -10},
                           {180, -lat}});
  EXPECT_EQ(trace.starts, (Starts{0, 4}));
  EXPECT_FALSE(trace.has_north_corners);
  // At the meridian of 0 degrees nothing is cut, and a corner on the antimeridian is in the east.
  const map::Trace front = traced({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}});
  EXPECT_TRUE(front.starts.empty());
  EXPECT_EQ(front.points.size(), 4U);
  const map::Trace corner = traced({{180, 0}, {-170, 5}, {170, 5}});
  EXPECT_EQ(corner.starts.size(), 2U);
  EXPECT_EQ(std::ranges::count(corner.points, LonLat{180, 0},
                               [](const map::MapPoint& p) { return p.position; }),
            2);
}

TEST(trace, sectors_at_the_poles) {
  const auto has_north = [](const std::vector<LonLat>& corners) {
    return traced(corners).has_north_corners;
  };
  EXPECT_FALSE(has_north({{10, 60}, {20, 60}, {0, 90}}));
  EXPECT_FALSE(has_north({{-20, 60}, {-10, 60}, {0, 90}}));
  EXPECT_TRUE(has_north({{170, 60}, {-170, 60}, {0, 90}}));
  EXPECT_FALSE(has_north({{20, -60}, {10, -60}, {0, -90}}));
  EXPECT_FALSE(has_north({{-170, -60}, {170, -60}, {0, -90}}));
  // Half of the sphere between meridians, with both poles on its border.
  EXPECT_FALSE(has_north({{0, -90}, {20, 0}, {0, 90}, {-160, 0}}));
  EXPECT_TRUE(has_north({{0, -90}, {-160, 0}, {0, 90}, {20, 0}}));
  const map::Trace sector = traced({{10, 60}, {20, 60}, {0, 90}});
  expect_positions(sector, {{10, 90}, {10, 60}, {20, 60}, {20, 90}});
  EXPECT_EQ(sector.starts, Starts{0});
  EXPECT_EQ(sector.arcs, (Arcs{2, 0, 1, 1}));
  const map::Trace two = traced({{0, -90}, {20, 0}, {0, 90}, {-160, 0}});
  expect_positions(two, {{20, -90}, {20, 0}, {20, 90}, {-160, 90}, {-160, 0}, {-160, -90}});
  EXPECT_EQ(two.starts, (Starts{0, 3}));
}

map::Trace traced_line(const std::vector<LonLat>& positions) {
  std::vector<Point> line;
  for (const LonLat& p : positions) line.push_back(on_sphere(p.lon_deg, p.lat_deg));
  map::Trace trace;
  map::draw_line(line, {4, 4, {}}, trace);
  return trace;
}

TEST(trace, lines_are_cut) {
  const map::Trace plain = traced_line({{10, 20}, {30, 40}});
  expect_positions(plain, {{10, 20}, {30, 40}});
  EXPECT_EQ(plain.starts, Starts{0});
  const map::Trace across = traced_line({{170, 20}, {-170, 20}, {-160, 0}});
  const double lat = latitude_at_antimeridian(20, 10);
  expect_positions(across, {{170, 20}, {180, lat}, {-180, lat}, {-170, 20}, {-160, 0}});
  EXPECT_EQ(across.starts, (Starts{0, 2}));
  EXPECT_EQ(across.arcs, (Arcs{0, 0, 0, 1, 1}));
  const map::Trace through = traced_line({{10, 80}, {-170, 70}});
  expect_positions(through, {{10, 80}, {10, 90}, {-170, 90}, {-170, 70}});
  EXPECT_EQ(through.starts, (Starts{0, 2}));
  const map::Trace south = traced_line({{10, -80}, {-170, -70}});
  expect_positions(south, {{10, -80}, {10, -90}, {-170, -90}, {-170, -70}});
  // The arc is over that pole that is nearer.
  const map::Trace over = traced_line({{10, -20}, {-170, 70}});
  expect_positions(over, {{10, -20}, {10, 90}, {-170, 90}, {-170, 70}});
  expect_positions(traced_line({{0, 90}, {30, 40}}), {{30, 90}, {30, 40}});
  expect_positions(traced_line({{30, 40}, {0, 90}}), {{30, 40}, {30, 90}});
  const map::Trace from_pole = traced_line({{0, 90}, {170, 20}, {-170, 20}});
  expect_positions(from_pole, {{170, 90}, {170, 20}, {180, lat}, {-180, lat}, {-170, 20}});
  EXPECT_EQ(from_pole.starts, (Starts{0, 3}));
  // An arc that passes the pole at a distance is cut nowhere but at the antimeridian.
  EXPECT_EQ(traced_line({{10, 80}, {100, 80}}).points.size(), 2U);
  EXPECT_EQ(traced_line({{10, 80}, {-169.999, 80}}).points.size(), 2U);
}

TEST(arc, points_next_to_borders_are_on_them) {
  const double near = 0.9 * map::merge_distance;
  const double far = 1.1 * map::merge_distance;
  EXPECT_EQ(map::snapped({near, 0, 1}), (Point{0, 0, 1}));
  EXPECT_EQ(map::snapped({0, near, -1}), (Point{0, 0, -1}));
  EXPECT_EQ(map::snapped({far, 0, 1}), (Point{far, 0, 1}));
  EXPECT_EQ(map::snapped({-0.6, near, 0.8}), (Point{-0.6, 0, 0.8}));
  EXPECT_EQ(map::snapped({-0.6, -near, 0.8}), (Point{-0.6, 0, 0.8}));
  EXPECT_EQ(map::snapped({-0.6, far, 0.8}), (Point{-0.6, far, 0.8}));
  EXPECT_EQ(map::snapped({0.6, near, 0.8}), (Point{0.6, near, 0.8}));
}

TEST(arc, antimeridian_has_two_longitudes) {
  EXPECT_EQ(map::lonlat_of({-1, 0, 0}, true), (LonLat{180, 0}));
  EXPECT_EQ(map::lonlat_of({-1, 0, 0}, false), (LonLat{-180, 0}));
  EXPECT_EQ(map::lonlat_of({1, 0, 0}, true), (LonLat{0, 0}));
  EXPECT_EQ(map::lonlat_of({1, 0, 0}, false), (LonLat{0, 0}));
  EXPECT_EQ(map::lonlat_of({0, -1, 0}, true), (LonLat{-90, 0}));
  EXPECT_EQ(map::map_point({-1, 0, 0}).position, (LonLat{180, 0}));
  for (double lon = -170; lon < 180; lon += 20) {
    for (double lat = -80; lat < 90; lat += 20) {
      const LonLat p = map::lonlat_of(on_sphere(lon, lat), true);
      EXPECT_NEAR(p.lon_deg, lon, 1e-12);
      EXPECT_NEAR(p.lat_deg, lat, 1e-12);
      EXPECT_LT(map::distance(map::point_at({lon, lat}), on_sphere(lon, lat)), 1e-15);
    }
  }
}

// Points along each drawn line are within the tolerance of the arc's plane, and not more points than half of them all were
// needed: without every second point some line would be too far away.
TEST(arc, lines_are_within_the_tolerance) {
  Random random(73);
  int num_points = 0;
  for (int round = 0; round < 300; ++round) {
    const auto end = [&] {
      return map::map_point(on_sphere(5 + 170 * random.unit(), 160 * random.unit() - 80));
    };
    const map::MapPoint p = end();
    const map::MapPoint q = end();
    const double tolerance = std::pow(10, -1 - 3 * random.unit());
    std::vector<map::MapPoint> points;
    map::append_arc(p, q, {tolerance, tolerance, {}}, points);
    std::vector<map::MapPoint> backward;
    map::append_arc(q, p, {tolerance, tolerance, {}}, backward);
    std::ranges::reverse(backward);
    ASSERT_EQ(points.size(), backward.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_EQ(points[i].position, backward[i].position);
    points.insert(points.begin(), p);
    points.push_back(q);
    const Point normal = normalized(cross(p.point, q.point));
    const auto farthest = [&](const LonLat& a, const LonLat& b) {
      double most = 0;
      for (int k = 1; k < 32; ++k) {
        const double t = k / 32.0;
        most = std::max(most, std::abs(dot(normal, on_sphere(std::lerp(a.lon_deg, b.lon_deg, t),
                                                             std::lerp(a.lat_deg, b.lat_deg, t)))));
      }
      return most;
    };
    double max_per_pairs = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      EXPECT_LE(farthest(points[i].position, points[i + 1].position), tolerance) << round;
      if (i > 0) {
        max_per_pairs =
            std::max(max_per_pairs, farthest(points[i - 1].position, points[i + 1].position));
      }
      EXPECT_LT(std::abs(dot(normal, points[i].point)), 1e-13);
    }
    if (points.size() > 2) {
      EXPECT_GT(max_per_pairs, tolerance / 3) << round;
    }
    num_points += static_cast<int>(points.size());
  }
  EXPECT_GT(num_points, 1000);
}

// Next to the center lines are within `least`, far from it within an eighth of the distance.
TEST(arc, lines_are_nearer_next_to_the_center) {
  const map::MapPoint p = map::map_point(on_sphere(10, 50));
  const map::MapPoint q = map::map_point(on_sphere(90, 50));
  const auto count = [&](const map::ArcTolerance& tolerance) {
    std::vector<map::MapPoint> points;
    map::append_arc(p, q, tolerance, points);
    return points.size();
  };
  const Point middle = normalized(p.point + q.point);
  const std::size_t coarse = count({0.05, 0.05, {}});
  const std::size_t fine = count({1e-5, 1e-5, {}});
  const std::size_t mixed = count({1e-5, 0.05, middle});
  EXPECT_LT(coarse, mixed);
  EXPECT_LT(mixed, fine / 2);
  EXPECT_EQ(count({1e-5, 0.05, -1.0 * middle}), coarse);
}

TEST(arc, one_line_needs_one_side_of_both_meridians) {
  const auto is_one = [](const LonLat& a, const LonLat& b, double tolerance) {
    return map::is_surely_one_line({on_sphere(a.lon_deg, a.lat_deg), a},
                                   {on_sphere(b.lon_deg, b.lat_deg), b}, tolerance);
  };
  EXPECT_TRUE(is_one({10, 20}, {10.5, 20.5}, 1e-3));
  EXPECT_FALSE(is_one({10, 20}, {10.5, 20.5}, 1e-6));
  EXPECT_TRUE(is_one({10, 20}, {10, 24}, 0));      // a meridian
  EXPECT_FALSE(is_one({10, 20}, {10, 26}, 1));     // 6 degrees are too long
  EXPECT_FALSE(is_one({-0.1, 20}, {0.1, 20}, 1));  // west and east
  EXPECT_FALSE(is_one({10, 89}, {10, 90}, 1));     // a pole
  EXPECT_FALSE(is_one({10, -90}, {10, -89}, 1));
}

// Three right angles enclose an eighth of the sphere; boxes between parallels are compared with their own formula.
TEST(ring_area, of_known_shapes) {
  const double pi = std::numbers::pi;
  std::vector<Point> octant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(map::area_on_left(octant), pi / 2, 1e-14);
  EXPECT_FALSE(map::is_clockwise(octant));
  std::ranges::reverse(octant);
  EXPECT_NEAR(map::area_on_left(octant), -pi / 2, 1e-14);
  EXPECT_TRUE(map::is_clockwise(octant));
  EXPECT_FALSE(map::is_surely_larger(octant, 0));  // a large ring: nothing is sure
  for (const double lat : {89.0, 60.0, 31.0, 10.0, -20.0, -80.0}) {
    std::vector<Point> cap;
    constexpr int corners = 720;
    for (int k = 0; k < corners; ++k) cap.push_back(on_sphere(-179.9 + k * 360.0 / corners, lat));
    const double area = 2 * pi * (1 - std::sin(lat * radian));
    // Known up to 4 pi, from -2 pi to 2 pi.
    const double expected = area > 2 * pi ? area - 4 * pi : area;
    EXPECT_NEAR(map::area_on_left(cap), expected, 1e-4) << lat;
    EXPECT_EQ(map::is_clockwise(cap), expected < 0);
    std::ranges::reverse(cap);
    EXPECT_NEAR(map::area_on_left(cap), -expected, 1e-4) << lat;
    EXPECT_EQ(map::is_clockwise(cap), expected > 0);
    EXPECT_NEAR(map::areas_on_left(std::vector<std::vector<Point>>{cap, octant}),
                -expected - pi / 2, 1e-4);
  }
  // A ring that goes back on itself over a large way has no area.
  EXPECT_EQ(map::area_on_left(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 1, 0}}), 0);
}

}  // namespace
}  // namespace rondel::test::of_trace
