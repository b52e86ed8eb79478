// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using PointRing = std::vector<Point>;

// Counterclockwise around the z axis, turned by `tilt` about the y axis.
PointRing circle(double radius, double tilt = 0, int corners = 12) {
  PointRing ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners + 0.1;
    const Point p = {std::sin(radius) * std::cos(angle), std::sin(radius) * std::sin(angle),
                     std::cos(radius)};
    ring.push_back({std::cos(tilt) * p.x + std::sin(tilt) * p.z, p.y,
                    std::cos(tilt) * p.z - std::sin(tilt) * p.x});
  }
  return ring;
}
PointRing hole(double radius, double tilt = 0) {
  PointRing ring = circle(radius, tilt);
  std::ranges::reverse(ring);
  return ring;
}

// 2 pi less the turns at the corners (Gauss, Bonnet), brought into [-2 pi, 2 pi].
double area_by_turns(const PointRing& ring) {
  double turns = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& q = ring[(k + 1) % ring.size()];
    const Point before = cross(ring[k], q);
    const Point behind = cross(q, ring[(k + 2) % ring.size()]);
    turns += std::atan2(dot(q, cross(before, behind)), dot(before, behind));
  }
  return std::remainder(2 * std::numbers::pi - turns, 4 * std::numbers::pi);
}

TEST(overlay_rings, areas_on_the_left) {
  const double small = map::area_on_left(circle(1e-3, 1));
  const double octagon =
      12 * 0.5 * std::sin(2 * std::numbers::pi / 12);  // times the squared radius
  EXPECT_NEAR(small, octagon * 1e-6, 1e-12);
  for (const double radius : {0.3, 1.0, 1.5, 1.57, 2.0, 2.9}) {
    const PointRing ring = circle(radius);
    EXPECT_NEAR(map::area_on_left(ring), area_by_turns(ring), 1e-13) << radius;
  }
  // A lune of two halves of great circles.
  const PointRing lune = {{0, 0, 1}, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}};
  EXPECT_NEAR(std::abs(map::area_on_left(lune)), std::numbers::pi, 1e-14);
}

// The roundings of a sum of so many triangles would be some 1e-12 together.
TEST(overlay_rings, areas_of_very_many_corners) {
  constexpr int corners = 300'000;
  for (const double radius : {0.4, 1.2, 1.5}) {
    const long double half_angle = std::numbers::pi_v<long double> / corners;
    const long double c = std::cos(static_cast<long double>(radius));
    const long double s = std::sin(static_cast<long double>(radius));
    // A triangle at the center with two sides of this radius.
    const long double above = s * s * std::sin(2 * half_angle);
    const long double below = 1 + 2 * c + c * c + s * s * std::cos(2 * half_angle);
    const auto expected = static_cast<double>(corners * 2 * std::atan2(above, below));
    const double found = map::area_on_left(circle(radius, 0.7, corners));
    EXPECT_NEAR(found, expected, 1e-13) << radius;
  }
}

// The center of mass of caps at both poles, joined by a line to and fro, is the sphere's: no triangles there.
TEST(overlay_rings, areas_of_what_is_balanced) {
  for (const double tilt : {0.0, 0.4, std::numbers::pi / 2}) {
    PointRing ring = circle(0.5, tilt);
    ring.push_back(ring.front());
    const PointRing north = ring;
    for (const Point& p : north) ring.push_back({-p.x, -p.y, -p.z});
    std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(north.size()), ring.end());
    const Point side = normalized(cross(ring[0], ring[1]));  // so that no side has 180 degrees
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(north.size()), side);
    ring.push_back(side);
    EXPECT_NEAR(map::area_on_left(ring), 2 * map::area_on_left(circle(0.5)), 1e-14) << tilt;
    EXPECT_FALSE(map::is_clockwise(ring));
    std::ranges::reverse(ring);
    EXPECT_TRUE(map::is_clockwise(ring));
  }
}

// Caps with a thin wedge that ends opposite their centers, where triangles around the center of mass are ill-defined.
TEST(overlay_rings, areas_of_rings_with_a_corner_opposite_their_center) {
  Random random(71);
  for (int round = 0; round < 200; ++round) {
    const Point axis = random.direction();
    const Point u = normalized(cross(axis, random.direction()));
    const Point v = cross(axis, u);
    PointRing ring;
    for (int k = 0; k < 12; ++k) {
      const double angle = 0.002 + (2 * std::numbers::pi - 0.004) * k / 11;
      ring.push_back(std::cos(1.2) * axis +
                     std::sin(1.2) * (std::cos(angle) * u + std::sin(angle) * v));
    }
    ring.push_back(normalized(0.01 * random.direction() - axis));
    EXPECT_NEAR(map::area_on_left(ring), area_by_turns(ring), 1e-11) << round;
    std::ranges::reverse(ring);
    EXPECT_NEAR(map::area_on_left(ring), area_by_turns(ring), 1e-11) << round;
  }
}

TEST(overlay_rings, which_way_around) {
  // Of any number of corners, of any size, thin to a line, and not convex.
  for (const double radius : {1e-9, 0.3, 1.0, 1.57, 2.9}) {
    for (const int corners : {3, 5, 11, 12, 40}) {
      PointRing ring = circle(radius, 0.7, corners);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(map::is_clockwise(ring), map::area_on_left(ring) < 0) << radius << ' ' << corners;
        std::ranges::reverse(ring);
        EXPECT_EQ(map::is_clockwise(ring), map::area_on_left(ring) < 0) << radius << ' ' << corners;
        const double area = std::abs(map::area_on_left(ring));
        EXPECT_FALSE(map::is_surely_larger(ring, area));
        if (k == 0 && corners <= 11 && radius <= 0.3) {
          EXPECT_TRUE(map::is_surely_larger(ring, area / 40));
        }
        // The next corner goes to the middle, or beyond it.
        const auto at = static_cast<std::size_t>(k) % ring.size();
        ring[at] = normalized(ring[at] + ring[(at + ring.size() / 2) % ring.size()]);
      }
    }
  }
  EXPECT_TRUE(map::is_clockwise(hole(0.2, 0.8)));
  EXPECT_FALSE(map::is_clockwise(circle(0.2, 0.8)));
  const PointRing line = {{1, 0, 0}, {0.8, 0.6, 0}, {1, 0, 0}, {0.8, 0.6, 0}};
  EXPECT_FALSE(map::is_clockwise(line));
}

}  // namespace
}  // namespace rondel::test
