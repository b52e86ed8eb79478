// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops in the plane: sides that cancel, sides around a position, loops traced from sides, and the
// polygons of loops.
#include "map/planar_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "map/settled_regions.h"

namespace rondel::test::of_planar_loops {
namespace {

using map::DirectedLine;
using map::Loop;
using Sides = std::vector<DirectedLine>;

Loop box(double west, double east, double south, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

Loop backward(Loop loop) {
  std::ranges::reverse(loop);
  return loop;
}

Loop closed(Loop loop) {
  loop.push_back(loop.front());
  return loop;
}

Sides sides_of(const std::vector<Loop>& loops) { return map::sides_of_loops(loops); }

TEST(planar_loops, touch_where_a_position_occurs_twice) {
  EXPECT_FALSE(map::has_touching(std::vector<Loop>{box(0, 2, 0, 2), box(3, 5, 0, 2)}));
  EXPECT_TRUE(map::has_touching(std::vector<Loop>{box(0, 2, 0, 2), box(2, 5, 2, 4)}));
  EXPECT_TRUE(map::has_touching(std::vector<Loop>{{{0, 0}, {4, 0}, {2, 2}, {0, 4}, {2, 2}}}));
  // The longitudes are equal, and the latitudes are, but no position is.
  EXPECT_FALSE(map::has_touching(std::vector<Loop>{box(0, 2, 0, 2), box(0, 2, 3, 5)}));
}

// Two boxes side by side lose the sides between them; the other sides keep their order.
TEST(planar_loops, opposite_sides_cancel) {
  Sides sides = sides_of({box(0, 2, 0, 2), box(2, 4, 0, 2)});
  map::cancel_opposite(sides);
  EXPECT_EQ(sides, (Sides{{{0, 0}, {2, 0}},
                          {{2, 2}, {0, 2}},
                          {{0, 2}, {0, 0}},
                          {{2, 0}, {4, 0}},
                          {{4, 0}, {4, 2}},
                          {{4, 2}, {2, 2}}}));
  // One side back takes away one of the sides there and leaves the others.
  const DirectedLine there{{1, 5}, {3, 4}};
  const DirectedLine back{{3, 4}, {1, 5}};
  for (Sides some : {Sides{there, back, there}, {back, there, there}, {there, there, back}}) {
    map::cancel_opposite(some);
    EXPECT_EQ(some, Sides{there});
  }
  Sides all = {there, there, back, back};
  map::cancel_opposite(all);
  EXPECT_TRUE(all.empty());
}

// At (0, 0), counterclockwise from the east, there are other sides between those of one loop, or there are not.
TEST(planar_loops, sides_that_do_not_alternate_are_unpaired) {
  const Loop east = {{0, 0}, {4, -1}, {4, 1}};
  const Loop west = {{0, 0}, {-4, 1}, {-4, -1}};
  EXPECT_TRUE(map::unpaired_sides(sides_of({east, west})).empty());
  EXPECT_TRUE(map::unpaired_sides(sides_of({east, box(6, 7, 0, 1)})).empty());
  // A wide triangle and a narrow one in it: two sides leave, then two sides reach the corner.
  const Loop wide = {{0, 0}, {4, 1}, {1, 4}};
  const Loop narrow = {{0, 0}, {2, 1}, {1, 2}};
  const std::vector<map::SideWedge> wedges = map::unpaired_sides(sides_of({wide, narrow}));
  ASSERT_EQ(wedges.size(), 4U);
  const std::vector<LonLat> around = {{4, 1}, {2, 1}, {1, 2}, {1, 4}, {4, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(wedges[i].at, (LonLat{0, 0}));
    EXPECT_EQ(wedges[i].first, around[i]) << i;
    EXPECT_EQ(wedges[i].second, around[i + 1]) << i;
    EXPECT_EQ(wedges[i].is_paired, i % 2 == 1) << i;  // one leaves and one reaches the corner
  }
}

// Each loop begins at its westernmost position.
TEST(planar_loops, are_traced_from_their_sides_in_any_order) {
  Sides sides = sides_of({box(0, 2, 0, 2), box(5, 7, 0, 2)});
  std::ranges::reverse(sides);
  EXPECT_EQ(map::traced_loops(sides), (std::vector<Loop>{box(0, 2, 0, 2), box(5, 7, 0, 2)}));
}

// Two boxes that touch in (2, 2) share no loop, and a hole that touches its ring in (0, 0) is a loop of its own.
TEST(planar_loops, that_touch_are_traced_apart) {
  EXPECT_EQ(map::traced_loops(sides_of({box(0, 2, 0, 2), box(2, 4, 2, 4)})),
            (std::vector<Loop>{box(0, 2, 0, 2), box(2, 4, 2, 4)}));
  EXPECT_EQ(map::traced_loops(sides_of({box(0, 2, 2, 4), box(2, 4, 0, 2)})),
            (std::vector<Loop>{box(0, 2, 2, 4), box(2, 4, 0, 2)}));
  const Loop ring = {{0, 0}, {4, 0}, {0, 4}};
  const Loop hole = {{0, 0}, {1, 2}, {2, 1}};
  const std::vector<Loop> loops = map::traced_loops(sides_of({ring, hole}));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_NE(std::ranges::find(loops, ring), loops.end());
  EXPECT_NE(std::ranges::find_if(loops,
                                 [&](const Loop& loop) {
                                   return loop.size() == 3 && map::doubled_loop_area(loop) == -3;
                                 }),
            loops.end());
}

// A loop inside of which sides lead to a second visit of (0, 0) and a third one of (2, 0) is divided at both.
TEST(planar_loops, a_walk_that_visits_positions_twice_is_divided) {
  const std::vector<Loop> petals = {{{0, 0}, {3, -1}, {3, 1}},
                                    {{0, 0}, {1, 3}, {-1, 3}},
                                    {{0, 0}, {-3, 1}, {-3, -1}},
                                    {{-3, 1}, {-4, 3}, {-5, 2}}};
  const std::vector<Loop> loops = map::traced_loops(sides_of(petals));
  ASSERT_EQ(loops.size(), 4U);
  double doubled = 0;
  for (const Loop& loop : loops) {
    EXPECT_EQ(loop.size(), 3U);
    EXPECT_GT(map::doubled_loop_area(loop), 0);
    doubled += map::doubled_loop_area(loop);
  }
  double expected = 0;
  for (const Loop& petal : petals) expected += map::doubled_loop_area(petal);
  EXPECT_EQ(doubled, expected);
}

// Two holes that touch their ring in (6, 0), where one walk through the region comes by three times.
TEST(planar_loops, a_ring_that_two_holes_touch_in_one_corner_is_divided) {
  const Loop ring = {{-6, -6}, {6, 0}, {-6, 6}};
  const Loop north = {{6, 0}, {2, 0.5}, {2, 1.5}};
  const Loop south = {{6, 0}, {2, -1.5}, {2, -0.5}};
  const std::vector<Loop> loops = map::traced_loops(sides_of({ring, north, south}));
  ASSERT_EQ(loops.size(), 3U);
  for (const Loop& expected : {ring, north, south})
    EXPECT_NE(std::ranges::find(loops, expected), loops.end());
}

// A ring with two holes, and an island in one of them that has a hole itself.
TEST(planar_loops, become_polygons_with_their_holes) {
  const Loop ring = box(0, 20, 0, 10);
  const Loop hole = backward(box(1, 9, 1, 9));
  const Loop other_hole = backward(box(11, 19, 1, 9));
  const Loop island = box(2, 8, 2, 8);
  const Loop pond = backward(box(3, 7, 3, 7));
  const auto found = map::polygons_of_loops({pond, island, hole, ring, other_hole});
  EXPECT_TRUE(found.misplaced.empty());
  ASSERT_EQ(found.polygons.size(), 2U);
  EXPECT_EQ(found.polygons[0].rings, (std::vector<Loop>{closed(island), closed(pond)}));
  EXPECT_EQ(found.polygons[1].rings,
            (std::vector<Loop>{closed(ring), closed(hole), closed(other_hole)}));
}

TEST(planar_loops, that_have_the_region_on_the_wrong_side_are_misplaced) {
  // A clockwise loop alone, and a counterclockwise one in another.
  EXPECT_EQ(map::polygons_of_loops({backward(box(0, 2, 0, 2))}).misplaced.size(), 1U);
  const auto two = map::polygons_of_loops({box(0, 9, 0, 9), box(2, 7, 2, 7)});
  EXPECT_EQ(two.misplaced, (std::vector<Loop>{box(2, 7, 2, 7)}));
  ASSERT_EQ(two.polygons.size(), 1U);
  EXPECT_EQ(two.polygons[0].rings, (std::vector<Loop>{closed(box(0, 9, 0, 9))}));
  // The place of a polygon is not that of its loop where loops before it are misplaced.
  const auto three = map::polygons_of_loops(
      {box(2, 7, 2, 7), box(0, 9, 0, 9), box(20, 29, 0, 9), backward(box(21, 28, 1, 8))});
  EXPECT_EQ(three.misplaced, (std::vector<Loop>{box(2, 7, 2, 7)}));
  ASSERT_EQ(three.polygons.size(), 2U);
  EXPECT_EQ(three.polygons[1].rings,
            (std::vector<Loop>{closed(box(20, 29, 0, 9)), closed(backward(box(21, 28, 1, 8)))}));
}

// The ring next around the hole is misplaced, so the hole has no polygon.
TEST(planar_loops, a_hole_of_a_misplaced_loop_is_dropped) {
  const auto found = map::polygons_of_loops(
      {box(0, 9, 0, 9), backward(box(1, 8, 1, 8)), backward(box(10, 19, 0, 9)), box(2, 7, 2, 7)});
  EXPECT_EQ(found.misplaced, (std::vector<Loop>{backward(box(10, 19, 0, 9))}));
  EXPECT_EQ(found.polygons.size(), 2U);
}

}  // namespace
}  // namespace rondel::test::of_planar_loops
