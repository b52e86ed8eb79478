// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Shared lines and the mending of single troubles, with positions computed by hand.
#include "map/mending.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "map/shared_lines.h"

namespace rondel::test::of_mending {
namespace {

using map::DirectedLine;
using map::Loop;
using map::Trouble;
using Kind = map::Trouble::TroubleKind;

constexpr double in_radians = std::numbers::pi / 180;

std::vector<DirectedLine> sides_with(const map::SharedLines& lines, const Loop& loop) {
  std::vector<DirectedLine> sides;
  lines.append_sides(loop, sides);
  return sides;
}

TEST(shared_lines, divide_a_line_in_both_directions) {
  map::SharedLines lines;
  EXPECT_TRUE(lines.is_empty());
  EXPECT_FALSE(lines.divide({0, 0}, {4, 0}, {4, 0}));
  EXPECT_FALSE(lines.divide({0, 0}, {4, 0}, {0, 0}));
  EXPECT_TRUE(lines.is_current({0, 0}, {4, 0}));
  EXPECT_TRUE(lines.divide({4, 0}, {0, 0}, {1, 1}));
  EXPECT_FALSE(lines.is_empty());
  EXPECT_FALSE(lines.is_current({0, 0}, {4, 0}));
  EXPECT_FALSE(lines.divide({0, 0}, {4, 0}, {2, 2}));
  EXPECT_TRUE(lines.divide({1, 1}, {4, 0}, {3, 2}));
  const std::vector<DirectedLine> forward = {
      {{4, 4}, {0, 0}}, {{0, 0}, {1, 1}}, {{1, 1}, {3, 2}}, {{3, 2}, {4, 0}}, {{4, 0}, {4, 4}}};
  EXPECT_EQ(sides_with(lines, {{0, 0}, {4, 0}, {4, 4}}), forward);
  const std::vector<DirectedLine> backward = {
      {{0, 0}, {4, 4}}, {{4, 4}, {4, 0}}, {{4, 0}, {3, 2}}, {{3, 2}, {1, 1}}, {{1, 1}, {0, 0}}};
  EXPECT_EQ(sides_with(lines, {{4, 4}, {4, 0}, {0, 0}}), backward);
  EXPECT_TRUE(sides_with(lines, {}).empty());
}

TEST(shared_lines, merge_into_the_lower_position_or_that_on_the_border) {
  const LonLat low{10, 20};
  const LonLat high{10, 20 + 5e-7};
  const LonLat border{180, 5};
  const LonLat inside{180 - 5e-7, 5};
  for (const bool is_swapped : {false, true}) {
    const auto merge = [&](map::SharedLines& lines, const LonLat& a, const LonLat& b) {
      return is_swapped ? lines.merge(b, a) : lines.merge(a, b);
    };
    map::SharedLines lines;
    EXPECT_TRUE(merge(lines, low, high));
    EXPECT_EQ(lines.place(high), low);
    EXPECT_EQ(lines.place(low), low);
    EXPECT_FALSE(merge(lines, low, high));
    EXPECT_FALSE(lines.is_current(high, {0, 0}));
    EXPECT_FALSE(lines.is_current({0, 0}, high));
    EXPECT_TRUE(lines.is_current({0, 0}, low));
    EXPECT_TRUE(merge(lines, border, inside));
    EXPECT_EQ(lines.place(inside), border);
    // Far apart, and a corner of the border with a position on another side of it.
    EXPECT_FALSE(merge(lines, {0, 0}, {0, 2e-6}));
    EXPECT_FALSE(merge(lines, {180, 90}, {180 - 5e-7, 90}));
    EXPECT_TRUE(merge(lines, {180, 90}, {180, 90 - 5e-7}));
    EXPECT_EQ(lines.place({180, 90}), (LonLat{180, 90 - 5e-7}));
    // What is merged twice is found.
    EXPECT_TRUE(merge(lines, low, {10, 20 - 5e-7}));
    EXPECT_EQ(lines.place(high), (LonLat{10, 20 - 5e-7}));
    // A side between merged positions is gone.
    EXPECT_EQ(sides_with(lines, {high, low, {11, 21}}).size(), 2U);
  }
}

// A line that would become a part of itself: the nearer end is merged with the place instead.
TEST(shared_lines, never_lead_back) {
  const LonLat a{0, 0};
  const LonLat b{4e-7, 0};
  const LonLat c{1e-7, 1e-7};
  map::SharedLines lines;
  EXPECT_TRUE(lines.divide(a, b, c));
  EXPECT_TRUE(lines.divide(c, b, a));
  EXPECT_EQ(lines.place(c), a);
  EXPECT_EQ(lines.place(b), b);
  EXPECT_EQ(sides_with(lines, {a, b}).size(), 2U);

  map::SharedLines far;
  EXPECT_TRUE(far.divide({0, 0}, {4, 0}, {1, 1}));
  EXPECT_FALSE(far.divide({1, 1}, {4, 0}, {0, 0}));
  EXPECT_EQ(far.place({1, 1}), (LonLat{1, 1}));
  EXPECT_TRUE(far.is_current({1, 1}, {4, 0}));
}

struct Expected {
  LonLat a;
  LonLat b;
  LonLat position;
  bool is_merge = false;
};

void expect_changes(const map::Mending& mending, const std::vector<Expected>& expected) {
  const auto& changes = mending.changes();
  ASSERT_EQ(changes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(changes[i].a, expected[i].a) << i;
    EXPECT_EQ(changes[i].b, expected[i].b) << i;
    EXPECT_NEAR(changes[i].position.lon_deg, expected[i].position.lon_deg, 1e-11) << i;
    EXPECT_NEAR(changes[i].position.lat_deg, expected[i].position.lat_deg, 1e-11) << i;
    EXPECT_EQ(changes[i].is_merge, expected[i].is_merge) << i;
  }
}

void expect_mended(const Trouble& trouble, const std::vector<Expected>& expected, int pass = 0) {
  map::SharedLines lines;
  map::Mending mending(lines, pass);
  mending.mend(trouble);
  expect_changes(mending, expected);
}

// The latitude of the middle of an arc between two positions of the same latitude.
double middle_latitude(double lat_deg, double lon_between_deg) {
  return std::atan(std::tan(lat_deg * in_radians) / std::cos(lon_between_deg / 2 * in_radians)) /
         in_radians;
}

// The latitude of the foot, on a meridian, of a position `away_deg` of longitude from it.
double foot_latitude(double lat_deg, double away_deg) {
  return std::atan(std::tan(lat_deg * in_radians) / std::cos(away_deg * in_radians)) / in_radians;
}

TEST(mending, divides_a_line_where_a_corner_touches_it) {
  expect_mended({Kind::touching, {1, 2}, {5, 6}, {3, 4}}, {{{1, 2}, {5, 6}, {3, 4}}});
}

TEST(mending, gives_crossing_lines_the_feet_of_the_ends) {
  expect_mended({Kind::crossing, {0, -1}, {0, 1}, {-2, 0}, {2, 0}},
                {{{0, -1}, {0, 1}, {0, 0}}, {{-2, 0}, {2, 0}, {0, 0}}});
}

// Lines from pole to pole have no feet and no middles: they are divided where they cross, a quarter of the way.
TEST(mending, divides_lines_at_their_crossing_at_last) {
  const LonLat a{0, 90};
  const LonLat b{30, -90};
  const LonLat c{10, 90};
  const LonLat d{0, -90};
  expect_mended({Kind::crossing, a, b, c, d}, {{a, b, {7.5, 45}}, {c, d, {7.5, 45}}});
  expect_mended({Kind::crossing, b, a, c, d}, {{b, a, {7.5, 45}}, {c, d, {7.5, 45}}});
  expect_mended({Kind::crossing, a, b, d, c}, {{a, b, {7.5, 45}}, {d, c, {7.5, 45}}});
  // Lines that are parallel up to rounding have no place where they cross; an end of one is taken.
  expect_mended({Kind::crossing, a, b, c, {40, -90}}, {{a, b, c}});
}

// The ends of a short line have feet on a long line, and its ends have none on the short one. The long line is divided at the
// first foot, and nothing else changes.
TEST(mending, divides_a_long_line_at_the_foot_of_a_short_one) {
  const LonLat a{0, 0};
  const LonLat b{40, 0};
  const LonLat c{19, 4};
  const LonLat d{21, -2};
  expect_mended({Kind::crossing, a, b, c, d}, {{a, b, {19, 0}}});
  expect_mended({Kind::crossing, a, b, d, c}, {{a, b, {21, 0}}});
  expect_mended({Kind::crossing, c, d, a, b}, {{a, b, {19, 0}}});
  expect_mended({Kind::crossing, d, c, a, b}, {{a, b, {21, 0}}});
}

// Next to a pole, ends are near on the sphere and far apart on the map. They are not merged, and the lines are aligned.
TEST(mending, aligns_lines_whose_near_ends_it_cannot_merge) {
  const LonLat a{0, 90 - 1e-13};
  const LonLat b{30, 0};
  const LonLat c{40, 90 - 1e-13};
  const LonLat d{-10, 20};
  map::SharedLines lines;
  map::Mending mending(lines, 0);
  mending.mend({Kind::crossing, a, b, c, d});
  ASSERT_EQ(mending.changes().size(), 1U);
  EXPECT_FALSE(mending.changes()[0].is_merge);
  EXPECT_NEAR(mending.changes()[0].position.lat_deg, foot_latitude(20, 40), 1e-9);
}

TEST(mending, merges_ends_within_reach) {
  const LonLat a{10, 20};
  const LonLat near{10, 20 + 1e-13};
  const LonLat b{10, 30};
  const LonLat c{12, 25};
  for (const Trouble& lines : {Trouble{Kind::crossing, a, b, near, c},
                               {Kind::crossing, b, a, near, c},
                               {Kind::crossing, b, a, c, near},
                               {Kind::crossing, a, b, c, near},
                               {Kind::crossing, a, near, b, c},
                               {Kind::crossing, b, c, a, near}}) {
    expect_mended(lines, {{a, near, a, true}});
  }
  // Lines that have been divided are left alone.
  map::SharedLines shared;
  shared.divide(a, b, {11, 25});
  map::Mending mending(shared, 0);
  mending.mend({Kind::crossing, a, b, near, c});
  mending.mend({Kind::crossing, near, c, a, b});
  mending.mend({Kind::unpaired, a, b, a, near});
  mending.mend({Kind::unpaired, a, near, a, b});
  EXPECT_TRUE(mending.changes().empty());
}

TEST(mending, bisects_first_in_every_third_late_pass) {
  const Trouble lines{Kind::crossing, {0, 50}, {40, 50}, {10, 40}, {10, 60}};
  const double middle = middle_latitude(50, 40);
  for (const int pass : {26, 29}) {
    expect_mended(lines, {{{0, 50}, {40, 50}, {20, middle}}}, pass);  // the other is a meridian
  }
  for (const int pass : {0, 2, 23, 24, 25}) {
    map::SharedLines shared;
    map::Mending mending(shared, pass);
    mending.mend(lines);
    ASSERT_EQ(mending.changes().size(), 2U) << pass;
    EXPECT_NE(mending.changes()[0].position.lon_deg, 20) << pass;
  }
}

TEST(mending, pairs_lines_by_the_foot_of_an_end) {
  const LonLat a{10, 0};
  const LonLat b{10, 40};
  const LonLat d{11, 20};
  const LonLat foot{10, foot_latitude(20, 1)};
  expect_mended({Kind::unpaired, a, b, a, d}, {{a, b, foot}});
  expect_mended({Kind::unpaired, a, d, a, b}, {{a, b, foot}});
}

TEST(mending, pairs_lines_without_feet_by_their_middles) {
  const LonLat a{10, 50};
  const LonLat b{50, 50};
  const LonLat d{-30, 50};
  const double middle = middle_latitude(50, 40);
  expect_mended({Kind::unpaired, a, b, a, d}, {{a, b, {30, middle}}, {a, d, {-10, middle}}});
}

TEST(mending, snaps_a_line_to_the_end_of_another) {
  const LonLat a{0, 0};
  const LonLat b{0, 40};
  const LonLat d{1e-13, 20};
  expect_mended({Kind::beside, a, b, a, d}, {{a, b, d}});
  expect_mended({Kind::beside, a, d, a, b}, {{a, b, d}});
  expect_mended({Kind::beside, a, b, a, {1e-11, 20}}, {});  // out of reach
  const LonLat beside_b{1e-13, 40};
  expect_mended({Kind::beside, a, b, a, beside_b}, {{b, beside_b, b, true}});
  expect_mended({Kind::beside, a, beside_b, a, b}, {{beside_b, b, b, true}});
  expect_mended({Kind::beside, a, {0, 90}, a, {1e-13, 20}}, {});  // poles stay
}

LonLat unit_foot(const LonLat& corner, const LonLat& a, const LonLat& b) {
  const Point normal = normalized(cross(map::point_at(a), map::point_at(b)));
  const Point v = map::point_at(corner);
  const Point foot = normalized(v - dot(v, normal) * normal);
  return {std::atan2(foot.y, foot.x) / in_radians, std::asin(foot.z) / in_radians};
}

// Each corner gives the line next to it its foot.
TEST(mending, turns_a_loop_by_the_feet_of_its_corners) {
  const Loop triangle = {{0, 0}, {40, 0}, {10, 30}};
  Trouble trouble{.kind = Kind::turned, .loop = triangle};
  expect_mended(trouble, {{triangle[1], triangle[2], unit_foot({0, 0}, {40, 0}, {10, 30})},
                          {triangle[2], triangle[0], unit_foot({40, 0}, {10, 30}, {0, 0})},
                          {triangle[0], triangle[1], {10, 0}}});
  // The feet of the upper corners are on the lower line, which is divided once; others are on none.
  trouble.loop = {{0, 0}, {40, 0}, {30, 5}, {10, 5}};
  expect_mended(trouble, {{{0, 0}, {40, 0}, {30, 0}}});
  // Of the lines below the notch and on both sides of it, that below is nearest.
  const Loop notched = {{0, 0}, {40, 0}, {41, 10}, {20, 2}, {-1, 10}};
  trouble.loop = notched;
  const auto foot_of = [&](std::size_t corner, std::size_t line) {
    const LonLat& a = notched[line];
    const LonLat& b = notched[(line + 1) % notched.size()];
    return Expected{a, b, unit_foot(notched[corner], a, b)};
  };
  expect_mended(trouble,
                {foot_of(0, 3), foot_of(1, 2), foot_of(2, 4), foot_of(3, 0), foot_of(4, 1)});
}

// No corner has a foot, as the longitudes differ by more than 90 degrees: all lines are bisected, the last one too.
TEST(mending, turns_a_loop_without_feet_by_the_middles_of_its_lines) {
  const Loop loop = {{0, 90}, {-50, 50}, {50, 50}};
  expect_mended({.kind = Kind::turned, .loop = loop},
                {{loop[0], loop[1], {-50, 70}},
                 {loop[1], loop[2], {0, middle_latitude(50, 100)}},
                 {loop[2], loop[0], {50, 70}}});
}

}  // namespace
}  // namespace rondel::test::of_mending
