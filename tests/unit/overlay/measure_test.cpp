// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How pieces are measured: local coordinates, triangles, moments, and what counts as rounding.
#include "overlay/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "overlay/region_area.h"
#include "rondel/error.h"
#include "support/random.h"
#include "support/thrown.h"
#include "unit/overlay/support.h"

namespace rondel::test::of_measure {
namespace {

using overlay::BorderArc;
using overlay::LocalAxes;
using overlay::Triangle;
constexpr double pi = std::numbers::pi;

// A point has the distances and the height over the tangent plane that it has in space, wherever o is.
TEST(local_axes, keep_distances) {
  Random random(88);
  for (int round = 0; round < 100; ++round) {
    Point o = random.direction();
    if (round < 2) o = {0, 0, round == 0 ? 1.0 : -1.0};
    const LocalAxes axes(o);
    const Point p = random.direction();
    const Point q = random.direction();
    const overlay::LocalPoint at_p = axes.place_of(p);
    const overlay::LocalPoint at_q = axes.place_of(q);
    EXPECT_NEAR(at_p.z, dot(o, p) - 1, 1e-15);
    EXPECT_NEAR(dot(at_p, at_p), dot(p - o, p - o), 1e-14);
    EXPECT_NEAR(dot(at_q - at_p, at_q - at_p), dot(q - p, q - p), 1e-14);
    // Counterclockwise stays counterclockwise.
    EXPECT_NEAR(at_p.x * at_q.y - at_p.y * at_q.x, dot(o, cross(p, q)), 1e-14);
  }
  const overlay::LocalPoint at_o = LocalAxes({0.6, 0, 0.8}).place_of({0.6, 0, 0.8});
  EXPECT_EQ(dot(at_o, at_o), 0);
}

// By differences of the corners, in the longer precision.
double area_of_triangle(const Point& o, const Point& p, const Point& q) {
  const LongVector at_o = long_vector(o);
  const LongVector at_p = long_vector(p);
  const LongVector at_q = long_vector(q);
  const auto from_o = [&](const LongVector& v) {
    return LongVector{v.x - at_o.x, v.y - at_o.y, v.z - at_o.z};
  };
  const auto length = [](const LongVector& v) { return std::sqrt(dot_of(v, v)); };
  const long double volume = dot_of(at_o, cross_of(from_o(at_p), from_o(at_q)));
  const long double below = length(at_o) * length(at_p) * length(at_q) +
                            dot_of(at_o, at_p) * length(at_q) + dot_of(at_p, at_q) * length(at_o) +
                            dot_of(at_q, at_o) * length(at_p);
  return static_cast<double>(2 * std::atan2(volume, below));
}

TEST(triangle, has_its_area_from_tiny_to_large) {
  Random random(89);
  for (const double size : {1e-9, 1e-5, 1e-3, 0.03, 0.06, 0.1, 0.5, 0.9}) {
    for (int round = 0; round < 30; ++round) {
      const Point o = random.direction();
      const auto near = [&] { return normalized(o + size * random.direction()); };
      const Point p = near();
      const Point q = near();
      const LocalAxes axes(o);
      const Triangle triangle(axes.place_of(p), axes.place_of(q));
      EXPECT_NEAR(triangle.area(), area_of_triangle(o, p, q), 4e-15 * size * size) << size;
      EXPECT_LE(norm(q - p), triangle.rough_length() * (1 + 1e-15) + 1e-16);
      EXPECT_LE(triangle.rough_length(), std::sqrt(3) * norm(q - p) + 1e-15);
      if (size < 0.6) {
        EXPECT_FALSE(triangle.is_large());
      }
    }
  }
  const LocalAxes axes({1, 0, 0});
  const Triangle octant(axes.place_of({0, 1, 0}), axes.place_of({0, 0, 1}));
  EXPECT_NEAR(octant.area(), pi / 2, 1e-15);
  EXPECT_TRUE(octant.is_large());
  const Triangle back(axes.place_of({0, 0, 1}), axes.place_of({0, 1, 0}));
  EXPECT_NEAR(back.area(), -pi / 2, 1e-15);
}

// The integral of each coordinate over an octant is pi / 4, and that of z over the northern hemisphere pi.
TEST(moments, of_arcs_add_up_to_those_of_regions) {
  const std::vector<Point> octant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Point moment{};
  for (std::size_t k = 0; k < 3; ++k)
    moment = moment + overlay::moment_of_arc(octant[k], octant[(k + 1) % 3]);
  for (const double coordinate : {moment.x, moment.y, moment.z})
    EXPECT_NEAR(coordinate, pi / 4, 1e-15);
  for (const int corners :
       {4, 100, 100'000}) {  // in each of these another formula computes the arcs
    double z = 0;
    for (int k = 0; k < corners; ++k) {
      const double a = 2 * pi * k / corners;
      const double b = 2 * pi * (k + 1) / corners;
      z += overlay::moment_of_arc({std::cos(a), std::sin(a), 0}, {std::cos(b), std::sin(b), 0}).z;
    }
    EXPECT_NEAR(z, pi, 1e-12) << corners;
  }
  EXPECT_EQ(overlay::moment_of_arc({0, 1, 0}, {0, 1, 0}), Point{});
  EXPECT_LE(1.0, overlay::rough_length({0, 0, 0}, {0.6, 0, 0.8}));
  EXPECT_DOUBLE_EQ(overlay::rough_length({1, 2, 3}, {0, 4, 2}), 4);
}

struct Piece {
  double area;
  double length;
  friend bool operator==(const Piece&, const Piece&) = default;
};
using Pieces = std::vector<Piece>;

Pieces without_rounding(Pieces pieces, double area, double length) {
  overlay::drop_rounding(pieces, area, length);
  return pieces;
}

TEST(drop_rounding, keeps_what_is_larger_than_rounding_of_its_border) {
  const double little = overlay::area_of_rounding(1);
  EXPECT_EQ(without_rounding({{0.5, 3}, {0.7, 3}}, 1.2, 4), (Pieces{{0.5, 3}, {0.7, 3}}));
  EXPECT_EQ(without_rounding({{little, 1}, {1, 3}}, 1, 4), (Pieces{{1, 3}}));
  EXPECT_EQ(without_rounding({{2 * little, 1}, {1, 3}}, 1, 4), (Pieces{{2 * little, 1}, {1, 3}}));
  EXPECT_EQ(without_rounding({{-little, 1}, {1, 3}}, 1, 4), (Pieces{{1, 3}}));
}

TEST(drop_rounding, keeps_the_largest_piece_of_a_cell_no_larger_than_rounding) {
  const double little = overlay::area_of_rounding(1);
  EXPECT_EQ(without_rounding({{little / 4, 1}, {little / 2, 1}, {0, 1}}, little, 1),
            (Pieces{{little / 2, 1}}));
  EXPECT_EQ(without_rounding({{0, 1}, {-little, 1}}, little, 1), Pieces{});
  EXPECT_EQ(without_rounding({{little / 4, 1}, {2 * little, 1}}, little, 1),
            (Pieces{{2 * little, 1}}));
}

// The cell is ten times as large as rounding, so that its pieces, each of which could be rounding, are no rounding together.
TEST(drop_rounding, loses_no_more_than_a_thousandth_of_a_cell) {
  const double little = overlay::area_of_rounding(1);
  Pieces pieces(12, {little * 0.8, 1});
  pieces.push_back({little * 1e-4, 1});
  const Pieces left = without_rounding(pieces, 10 * little, 1);
  EXPECT_EQ(left.size(), 12U);
}

TEST(require_sum, refuses_pieces_that_are_not_the_cell) {
  const auto sum = [](Pieces pieces, double area) {
    overlay::require_sum(pieces, area, 1, 17);
    return pieces.size();
  };
  EXPECT_EQ(sum({{0.25, 1}, {0.75, 1}}, 1), 2U);
  EXPECT_EQ(sum({{0.25, 1}, {0.75 + 1e-10, 1}}, 1), 2U);
  EXPECT_THROW(sum({{0.25, 1}, {0.75 + 1e-8, 1}}, 1), InvalidInput);
  EXPECT_THROW(sum({{0.25, 1}, {0.75 - 1e-8, 1}}, 1), InvalidInput);
  // A negative piece shows that the cell crosses itself, even where the sum is right.
  EXPECT_THROW(sum({{-0.25, 1}, {1.25, 1}}, 1), InvalidInput);
  // A cell that is no wider than rounding loses its pieces instead.
  EXPECT_EQ(sum({{-0.25, 1}, {1.25, 1}}, 1e-16), 0U);
  EXPECT_EQ(thrown_index([&] { sum({{0.5, 1}}, 1); }), 17U) << "half of a cell is not the cell";
}

std::vector<BorderArc> border_of(const std::vector<std::vector<Point>>& rings) {
  std::vector<BorderArc> border;
  for (const auto& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      border.push_back({ring[k], ring[(k + 1) % ring.size()]});
  }
  return border;
}

std::vector<Point> circle(double radius, int corners, bool is_hole = false) {
  std::vector<Point> ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners;
    ring.push_back(
        {std::cos(radius), std::sin(radius) * std::cos(angle), std::sin(radius) * std::sin(angle)});
  }
  if (is_hole) std::ranges::reverse(ring);
  return ring;
}

// A triangle at the center of a circle of this many corners.
double area_inside(double radius, int corners) {
  const double angle = 2 * pi / corners;
  const double s = std::sin(radius);
  const double c = std::cos(radius);
  return corners * 2 *
         std::atan2(s * s * std::sin(angle), 1 + 2 * c + c * c + s * s * std::cos(angle));
}

TEST(measures_of, regions_with_holes) {
  for (const double radius : {1e-4, 0.1, 0.7, 1.4}) {
    const auto ring = circle(radius, 12);
    const auto hole = circle(radius / 2, 7, true);
    const overlay::Measures whole = overlay::measures_of(border_of({ring}), ring[0]);
    EXPECT_NEAR(whole.area, area_inside(radius, 12), 1e-14 * radius);
    EXPECT_GE(whole.length, 12 * 2 * std::sin(pi / 12) * std::sin(radius) * (1 - 1e-9));
    EXPECT_NEAR(whole.moment.y, 0, 1e-14 * radius);
    EXPECT_GT(whole.moment.x, 0);
    EXPECT_TRUE(whole.is_sure);
    const overlay::Measures frame = overlay::measures_of(border_of({ring, hole}), ring[0]);
    EXPECT_NEAR(frame.area, area_inside(radius, 12) - area_inside(radius / 2, 7), 1e-14 * radius);
  }
  const overlay::Measures octant =
      overlay::measures_of(border_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), {1, 0, 0});
  EXPECT_NEAR(octant.area, pi / 2, 1e-14);
  EXPECT_NEAR(octant.moment.z, pi / 4, 1e-14);
}

TEST(region_area, is_between_nothing_and_the_sphere) {
  const auto value_of = [](const std::vector<std::vector<Point>>& rings) {
    overlay::RegionArea area;
    for (const auto& ring : rings) area.add(ring);
    return area.value();
  };
  EXPECT_EQ(value_of({}), 0);
  for (const double radius : {0.1, 1.0, 1.5}) {
    const double inside = area_inside(radius, 9);
    EXPECT_NEAR(value_of({circle(radius, 9)}), inside, 1e-13);
    EXPECT_NEAR(value_of({circle(radius, 9, true)}), 4 * pi - inside, 1e-13);
    const double hole = area_inside(radius / 3, 5);
    EXPECT_NEAR(value_of({circle(radius, 9), circle(radius / 3, 5, true)}), inside - hole, 1e-13);
    EXPECT_NEAR(value_of({circle(radius / 3, 5, true), circle(radius, 9)}), inside - hole, 1e-13);
  }
  // What rounding of corners may have turned over is nearly nothing, and not nearly all.
  const std::vector<Point> sliver = {{1, 0, 0}, {0.6, 0.8, 0}, normalized(Point{0.8, 0.6, -1e-17})};
  EXPECT_NEAR(value_of({sliver}), 0, 1e-15);
  EXPECT_TRUE(overlay::area_of_ring(sliver).is_nothing());
  EXPECT_FALSE(overlay::area_of_ring(circle(0.001, 9)).is_nothing());
  EXPECT_FALSE(overlay::area_of_ring(circle(0.001, 9, true)).is_nothing());
}

// Triangles with a right angle and two short legs: each sign and size is told from rounding, which is much less.
TEST(region_area, of_tiny_triangles_is_not_rounding) {
  for (const double leg : {1e-7, 1e-6, 1e-5, 1e-3, 0.1}) {
    const std::vector<Point> ring = {
        {1, 0, 0}, {std::cos(leg), std::sin(leg), 0}, {std::cos(leg), 0, std::sin(leg)}};
    const double t = std::tan(leg / 2);
    const double area = 2 * std::atan(t * t);
    const std::vector<Point> back(ring.rbegin(), ring.rend());
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<Point> turned = ring;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(k), turned.end());
      const overlay::RingArea found = overlay::area_of_ring(turned);
      EXPECT_FALSE(found.is_nothing()) << leg;
      EXPECT_NEAR(found.area, area, found.rounding) << leg;
      EXPECT_LT(found.rounding, leg < 1e-4 ? 1e-13 * leg + area / 50 : 1e-8);
    }
    EXPECT_NEAR(overlay::area_of_ring(back).area, -area, 1e-15 * leg + 1e-14 * area);
    overlay::RegionArea inside;
    inside.add(ring);
    EXPECT_NEAR(inside.value(), area, 1e-15 * leg + 1e-14 * area);
    overlay::RegionArea outside;
    outside.add(back);
    EXPECT_NEAR(outside.value(), 4 * pi - area, 1e-14);
    // A ring and the same as a hole are nothing.
    inside.add(back);
    EXPECT_NEAR(inside.value(), 0, 1e-14);
  }
}

}  // namespace
}  // namespace rondel::test::of_measure
