// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Projection and clipping of arcs and circles, on random ones and at the edges.
#include "globe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondel/delaunay.h"
#include "unit/plot/recorder.h"

namespace rondel::cli {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double curve_error = 1.1e-6;  // what trace_arc() promises, and rounding

void expect_near(const Point& a, const Point& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(view, its_center_faces_the_viewer_and_north_is_up) {
  const View view({30, 40});
  expect_near(view.turn(unit_vector({30, 40})), {0, 0, 1}, 1e-15);
  const Point north = view.turn({0, 0, 1});
  EXPECT_NEAR(north.x, 0, 1e-15);
  EXPECT_GT(north.y, 0);
  EXPECT_GT(view.turn(unit_vector({31, 40})).x, 0);
}

TEST(view, from_a_pole_is_exact) {
  const View view({0, 90});
  EXPECT_EQ(view.turn({0, 0, 1}), (Point{0, 0, 1}));
  EXPECT_EQ(view.turn({0, 1, 0}), (Point{1, 0, 0}));
  EXPECT_EQ(view.turn({1, 0, 0}), (Point{0, -1, 0}));
}

TEST(view, the_direction_that_points_up_is_clockwise_from_north) {
  const View view({0, 0}, 90);
  expect_near(view.turn(unit_vector({90, 0})), {0, 1, 0}, 1e-15);
  expect_near(view.turn({0, 0, 1}), {-1, 0, 0}, 1e-15);
}

TEST(visible_part, the_two_sides_make_up_the_arc_and_meet_on_the_limb) {
  Directions random(1);
  int num_cut = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Point a = random.next(), b = random.next();
    const auto front = visible_part(a, b, Side::front), back = visible_part(a, b, Side::back);
    double sum = 0;
    if (front) sum += angle_between(front->first, front->second);
    if (back) sum += angle_between(back->first, back->second);
    ASSERT_NEAR(sum, angle_between(a, b), 1e-12);
    if (!front || !back) continue;
    ++num_cut;
    const bool leaves = a.z > 0;
    const Point cut = leaves ? front->second : front->first;
    ASSERT_EQ(cut, leaves ? back->first : back->second);
    ASSERT_EQ(cut.z, 0);
    ASSERT_NEAR(length({cut.x, cut.y}), 1, 4e-16);
    ASSERT_NEAR(dot(cut, normalized(cross(a, b))), 0, 1e-12);
  }
  EXPECT_GT(num_cut, 2'000);
}

TEST(visible_part, of_an_arc_along_the_limb_is_in_front_alone) {
  const Point a{1, 0, 0}, b{0, 1, 0};
  EXPECT_TRUE(visible_part(a, b, Side::front));
  EXPECT_FALSE(visible_part(a, b, Side::back));
}

TEST(visible_part, an_arc_that_touches_the_limb_ends_there) {
  const Point on_limb{1, 0, 0}, front{0, 0, 1}, back{0, 0, -1};
  EXPECT_EQ(visible_part(front, on_limb, Side::front)->second, on_limb);
  EXPECT_FALSE(visible_part(front, on_limb, Side::back));
  EXPECT_EQ(visible_part(on_limb, back, Side::back)->first, on_limb);
  EXPECT_FALSE(visible_part(on_limb, back, Side::front));
}

TEST(visible_part, is_accurate_for_tiny_arcs_across_the_limb) {
  const Point a = normalized({1, 0, 3e-9}), b = normalized({1, 1e-9, -1e-9});
  const auto front = visible_part(a, b, Side::front);
  ASSERT_TRUE(front);
  EXPECT_NEAR(front->second.y, 0.75e-9, 1e-20);
}

TEST(trace_arc, follows_the_projected_great_circle) {
  Directions random(2);
  for (int i = 0; i < 2'000; ++i) {
    const Point a = random.next(), b = random.next();
    const double angle = angle_between(a, b);
    const Point v = normalized(cross(cross(a, b), a));
    const double determinant = a.x * v.y - a.y * v.x;
    if (std::abs(determinant) < 0.05) continue;  // seen nearly edge-on
    for (const Side side : {Side::front, Side::back}) {
      Recorder pen;
      trace_arc(pen, a, b, side, 1e-9);
      for (const auto& path : pen.paths) {
        for (const Spot p : path) {
          ASSERT_LE(length(p), 1 + curve_error);
          // p = a cos t + v sin t, with t between the ends.
          const double cosine = (p.x * v.y - p.y * v.x) / determinant;
          const double sine = (a.x * p.y - a.y * p.x) / determinant;
          ASSERT_NEAR(std::hypot(cosine, sine), 1, curve_error / std::abs(determinant));
          const double t = std::atan2(sine, cosine);
          ASSERT_GE(t, -1e-4);
          ASSERT_LE(t, angle + 1e-4);
          const double z = a.z * cosine + v.z * sine;
          ASSERT_GE(side == Side::front ? z : -z, -1e-4);
        }
      }
    }
  }
}

TEST(trace_arc, starts_and_ends_exactly_at_its_sites) {
  const Point a = normalized({0.3, -0.2, 0.9}), b = normalized({-0.7, 0.1, 0.2});
  Recorder pen;
  trace_arc(pen, a, b, Side::front, 1e-6);
  ASSERT_EQ(pen.paths.size(), 1U);
  EXPECT_EQ(pen.paths[0].front().x, a.x);
  EXPECT_NEAR(pen.paths[0].back().x, b.x, 1e-15);
  EXPECT_NEAR(pen.paths[0].back().y, b.y, 1e-15);
}

TEST(trace_arc, is_a_line_where_the_tolerance_allows_and_only_there) {
  const Point a{0, 0, 1};
  const double angle = 0.02;  // its chord is 5e-5 from the arc
  const Point b{std::sin(angle), 0, std::cos(angle)};
  Recorder coarse, fine;
  trace_arc(coarse, a, b, Side::front, 6e-5);
  trace_arc(fine, a, b, Side::front, 4e-5);
  EXPECT_EQ(coarse.num_lines, 1);
  EXPECT_EQ(coarse.num_curves, 0);
  EXPECT_EQ(fine.num_lines, 0);
  EXPECT_EQ(fine.num_curves, 1);
}

TEST(trace_arc, behind_the_globe_leaves_no_path) {
  Recorder pen;
  trace_arc(pen, normalized({0.1, 0, -1}), normalized({0, 0.1, -1}), Side::front, 1e-6);
  EXPECT_TRUE(pen.paths.empty());
}

TEST(trace_circle, keeps_its_distance_from_the_axis_and_to_its_side) {
  Directions random(3);
  for (int i = 0; i < 500; ++i) {
    const Point axis = random.next();
    for (const double radius : {15.0, 60.0, 90.0, 150.0}) {
      Recorder pen;
      trace_circle(pen, axis, radius, Side::front);
      trace_circle(pen, axis, radius, Side::back);
      for (const auto& path : pen.paths) {
        for (const Spot p : path) {
          ASSERT_LE(length(p), 1 + curve_error);
          // The circle's plane gives the height.
          const double z = (std::cos(radius * pi / 180) - axis.x * p.x - axis.y * p.y) / axis.z;
          ASSERT_NEAR(std::hypot(length(p), z), 1, 2 * curve_error / std::abs(axis.z));
        }
      }
      const bool crosses = std::abs(std::cos(radius * pi / 180)) < std::hypot(axis.x, axis.y);
      ASSERT_EQ(pen.paths.size(), crosses ? 2U : 1U);
    }
  }
}

TEST(trace_circle, ends_on_the_limb_when_it_crosses_it) {
  const View view({0, 20});
  Recorder pen;
  trace_circle(pen, view.turn({0, 0, 1}), 90, Side::front);
  ASSERT_EQ(pen.paths.size(), 1U);
  EXPECT_NEAR(length(pen.paths[0].front()), 1, 1e-15);
  EXPECT_NEAR(length(pen.paths[0].back()), 1, 1e-15);
  // The equator seen from 20 degrees north bends down, to sin 20 below the middle.
  double lowest = 0;
  for (const Spot p : pen.paths[0]) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, -std::sin(20 * pi / 180), 1e-4);
}

TEST(trace_circle, is_whole_or_absent_when_it_does_not_cross_the_limb) {
  const View view({0, 70});
  const Point north = view.turn({0, 0, 1});
  Recorder near, far;
  trace_circle(near, north, 30, Side::front);
  ASSERT_EQ(near.paths.size(), 1U);
  EXPECT_NEAR(std::abs(near.area()), pi * 0.25 * std::sin(70 * pi / 180), 1e-3);
  trace_circle(far, north, 150, Side::front);
  EXPECT_TRUE(far.paths.empty());
}

TEST(angle_between, is_accurate_for_tiny_and_for_straight_angles) {
  const double tiny = 1e-9;
  EXPECT_NEAR(angle_between({0, 0, 1}, {tiny, 0, 1}) / tiny, 1, 1e-12);
  EXPECT_NEAR(pi - angle_between({0, 0, 1}, {tiny, 0, -1}), tiny, 1e-15);
}

}  // namespace
}  // namespace rondel::cli
