// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which loops lie in which: loops that share all their corners, loops of any shape, and the holes of convex regions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "map/planar_loops.h"
#include "map/settled_regions.h"
#include "support/random.h"

namespace rondel::test {
namespace {

using map::Loop;

// A counterclockwise loop around a center, with corners between the two radii.
Loop star_shaped(Random& random, const LonLat& center, std::size_t corners, double least,
                 double most) {
  Loop loop;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5 * random.unit()) /
                         static_cast<double>(corners);
    const double radius = least + (most - least) * random.unit();
    loop.push_back(
        {center.lon_deg + radius * std::cos(angle), center.lat_deg + radius * std::sin(angle)});
  }
  const auto first = static_cast<std::ptrdiff_t>(random.below(corners));
  std::rotate(loop.begin(), loop.begin() + first, loop.end());
  return loop;
}

double turn_in_plane(const LonLat& a, const LonLat& b, const LonLat& c) {
  return (b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) -
         (b.lat_deg - a.lat_deg) * (c.lon_deg - a.lon_deg);
}

bool do_cross(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  return turn_in_plane(a, b, c) * turn_in_plane(a, b, d) < 0 &&
         turn_in_plane(c, d, a) * turn_in_plane(c, d, b) < 0;
}

// A place is inside if a line from it to the east crosses the loop an odd number of times.
bool has_in_it(const Loop& loop, const LonLat& p) {
  bool is_inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const LonLat& a = loop[k];
    const LonLat& b = loop[(k + 1) % loop.size()];
    if ((a.lat_deg > p.lat_deg) == (b.lat_deg > p.lat_deg)) continue;
    if ((turn_in_plane(a, b, p) > 0) == (b.lat_deg > a.lat_deg)) is_inside = !is_inside;
  }
  return is_inside;
}

// A counterclockwise loop in the shape of a C around a center.
Loop c_shaped(Random& random, const LonLat& center, std::size_t corners) {
  Loop loop;
  for (std::size_t k = 0; k < 2 * corners; ++k) {
    const bool is_back = k >= corners;
    const std::size_t place = is_back ? 2 * corners - 1 - k : k;
    const double angle = 5.5 * static_cast<double>(place) / static_cast<double>(corners);
    const double radius = (is_back ? 3 : 8) + 4 * random.unit();
    loop.push_back(
        {center.lon_deg + radius * std::cos(angle), center.lat_deg + radius * std::sin(angle)});
  }
  const auto first = static_cast<std::ptrdiff_t>(random.below(loop.size()));
  std::rotate(loop.begin(), loop.begin() + first, loop.end());
  return loop;
}

// Returns how many sides of a loop, whose corners are corners of another, have their middles in the other; nothing if sides
// cross, or if the loop has corners of the other in it.
std::optional<std::size_t> count_sides_inside(const Loop& loop, const Loop& other) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const LonLat& a = loop[i];
    const LonLat& b = loop[(i + 1) % loop.size()];
    for (std::size_t k = 0; k < other.size(); ++k) {
      if (do_cross(a, b, other[k], other[(k + 1) % other.size()])) return std::nullopt;
      if (std::ranges::find(loop, other[k]) == loop.end() && has_in_it(loop, other[k]))
        return std::nullopt;
    }
    const LonLat middle{(a.lon_deg + b.lon_deg) / 2, (a.lat_deg + b.lat_deg) / 2};
    count += has_in_it(other, middle) ? 1 : 0;
  }
  return count;
}

// Triangles whose three corners are corners of a loop: those that lie in it are its holes, others are in nothing.
TEST(owners_of, triangles_between_corners_of_a_loop) {
  Random random(41);
  std::array<int, 2> numbers{};
  for (int round = 0; round < 3000; ++round) {
    const Loop loop = c_shaped(random, {12, -34}, 7);
    const std::size_t first = random.below(loop.size());
    const std::size_t second = first + 2 + random.below(3);
    const std::size_t third = second + 2 + random.below(3);
    Loop triangle = {loop[first], loop[second % loop.size()], loop[third % loop.size()]};
    if (turn_in_plane(triangle[0], triangle[1], triangle[2]) > 0) std::ranges::reverse(triangle);
    const std::optional<std::size_t> sides_inside = count_sides_inside(triangle, loop);
    if (sides_inside != 0 && sides_inside != 3) continue;
    const bool is_inside = sides_inside == 3;
    ++numbers[is_inside ? 1 : 0];
    const std::vector<std::size_t> owners = map::owners_of(std::vector<Loop>{loop, triangle}, 1);
    EXPECT_EQ(owners[0], 0U);
    EXPECT_EQ(owners[1], is_inside ? 0U : map::misplaced) << round;
  }
  EXPECT_GT(numbers[0], 50);
  EXPECT_GT(numbers[1], 50);
}

// Rings in rings like those of a tree: a hole belongs to the ring next around it, wherever they are and whatever their shape.
TEST(owners_of, rings_around_rings_of_any_shape) {
  Random random(42);
  for (int round = 0; round < 300; ++round) {
    const LonLat center{300 * random.unit() - 150, 100 * random.unit() - 50};
    std::vector<Loop> outer;
    std::vector<Loop> holes;
    for (double radius = 24; radius > 1; radius /= 4) {
      const std::size_t corners = 8 + random.below(4);
      outer.push_back(star_shaped(random, center, corners, 0.8 * radius, radius));
      holes.push_back(star_shaped(random, center, corners, 0.4 * radius, 0.5 * radius));
      std::ranges::reverse(holes.back());
    }
    std::vector<std::size_t> expected(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i) expected[i] = i;
    expected.insert(expected.end(), expected.begin(), expected.end());
    outer.insert(outer.end(), holes.begin(), holes.end());
    EXPECT_EQ(map::owners_of(outer, holes.size()), expected) << round;
  }
}

double area_of(const std::vector<map::LonLatPolygon>& polygons) {
  double doubled = 0;
  for (const map::LonLatPolygon& polygon : polygons)
    doubled += map::doubled_loop_area(polygon.ring);
  return doubled / 2;
}

// A region in the shape of a U with a hole of that shape. What is in the hole goes with it; what is between the arms of the
// U, and in the rectangle around the hole, stays.
TEST(settled_regions, lose_their_holes_and_what_is_in_them) {
  const Loop u = {{0, 0}, {9, 0}, {9, 9}, {6, 9}, {6, 3}, {3, 3}, {3, 9}, {0, 9}};
  const Loop hole = {{1, 1}, {1, 8}, {2, 8}, {2, 2}, {7, 2}, {7, 8}, {8, 8}, {8, 1}};
  for (const double turn : {1.0, -1.0}) {  // the arms lead to the north or to the south
    const auto turned = [&](Loop loop) {
      for (LonLat& p : loop) p = {turn * p.lon_deg + 20, turn * p.lat_deg - 40};
      return loop;
    };
    const std::vector<std::vector<Loop>> regions = {
        {turned(u), turned(hole)},
        {turned({{1.25, 4}, {1.75, 4}, {1.5, 6}})},     // in an arm of the hole
        {turned({{4, 1.25}, {5, 1.25}, {4.5, 1.75}})},  // in its bottom
        {turned({{1, 1}, {2, 2}, {1, 8}})},             // with corners of the hole only
        {turned({{4, 4}, {5, 4}, {4.5, 6}})}};          // between the arms
    std::vector<std::vector<map::DirectedLine>> sides;
    for (const auto& loops : regions) sides.push_back(map::sides_of_loops(loops));
    const auto polygons = map::settled_convex_regions(sides, 1);
    ASSERT_EQ(polygons.size(), regions.size());
    EXPECT_EQ(area_of(polygons[0]), 81 - 18);
    EXPECT_TRUE(polygons[1].empty());
    EXPECT_TRUE(polygons[2].empty());
    EXPECT_TRUE(polygons[3].empty());
    EXPECT_EQ(area_of(polygons[4]), 1);
  }
}

}  // namespace
}  // namespace rondel::test
