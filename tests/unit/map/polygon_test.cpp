// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons of traces that are written by hand: loops that turn, touch themselves or go back.
#include "map/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "map/planar_loops.h"

namespace rondel::test::of_polygon {
namespace {

using WrittenLoop = std::vector<LonLat>;

map::Trace closed_trace(const WrittenLoop& loop) {
  map::Trace trace;
  for (const LonLat& p : loop) trace.points.push_back({{1, 0, 0}, p});
  return trace;
}

std::vector<WrittenLoop> rings_of(const map::Trace& trace) {
  std::vector<WrittenLoop> rings;
  for (const map::LonLatPolygon& polygon : map::polygons_of(trace)) rings.push_back(polygon.ring);
  return rings;
}

TEST(polygons_of, a_whole_ring_is_turned_to_be_counterclockwise) {
  const WrittenLoop loop = {{10, 10}, {14, 10}, {10, 13}};
  const map::Trace trace = closed_trace(loop);
  EXPECT_EQ(rings_of(trace), (std::vector<WrittenLoop>{{loop[0], loop[1], loop[2], loop[0]}}));
  EXPECT_FALSE(map::is_turned_over(trace));
  const map::Trace turned = closed_trace({loop[2], loop[1], loop[0]});
  EXPECT_EQ(rings_of(turned), (std::vector<WrittenLoop>{{loop[0], loop[1], loop[2], loop[0]}}));
  EXPECT_TRUE(map::is_turned_over(turned));
  EXPECT_EQ(map::drawn_loops(turned), (std::vector<WrittenLoop>{{loop[2], loop[1], loop[0]}}));
  // What is no wider than rounding is not told to be turned over.
  EXPECT_FALSE(map::is_turned_over(closed_trace({{10, 10}, {10, 10 + 1e-10}, {10 + 1e-10, 10}})));
  EXPECT_TRUE(rings_of(closed_trace({{10, 10}, {11, 11}, {13, 13}})).empty());
  EXPECT_TRUE(rings_of(closed_trace({{10, 10}, {11, 11}})).empty());
}

// Two triangles with a common corner: the one that is clockwise is dropped.
TEST(polygons_of, a_ring_that_touches_itself_is_divided) {
  const WrittenLoop both = {{0, 0}, {4, -2}, {4, 2}, {0, 0}, {-4, 2}, {-4, -2}};
  const WrittenLoop right = {{0, 0}, {4, -2}, {4, 2}, {0, 0}};
  const WrittenLoop left = {{0, 0}, {-4, 2}, {-4, -2}, {0, 0}};
  EXPECT_EQ(rings_of(closed_trace(both)), (std::vector<WrittenLoop>{right, left}));
  EXPECT_FALSE(map::is_turned_over(closed_trace(both)));
  const WrittenLoop one = {{0, 0}, {4, -2}, {4, 2}, {0, 0}, {-4, -2}, {-4, 2}};
  EXPECT_EQ(rings_of(closed_trace(one)), std::vector<WrittenLoop>{right});
  EXPECT_TRUE(map::is_turned_over(closed_trace(one)));
  // The same with so many corners that they are sorted to be compared.
  WrittenLoop many = {{0, 0}};
  for (int k = 0; k <= 40; ++k) many.push_back({4, -2 + k / 10.0});
  WrittenLoop arm = many;
  arm.push_back({0, 0});
  many.insert(many.end(), both.begin() + 3, both.end());
  EXPECT_EQ(rings_of(closed_trace(many)), (std::vector<WrittenLoop>{arm, left}));
}

// Three petals around (0, 0), which the ring visits three times, wherever it begins.
TEST(polygons_of, a_ring_that_touches_itself_twice_in_one_place_is_divided) {
  WrittenLoop petals = {{0, 0},  {4, -1}, {4, 1},  {0, 0},  {1, 4},
                        {-1, 4}, {0, 0},  {-4, 1}, {-4, -1}};
  EXPECT_EQ(rings_of(closed_trace(petals)),
            (std::vector<WrittenLoop>{{{0, 0}, {4, -1}, {4, 1}, {0, 0}},
                                      {{0, 0}, {1, 4}, {-1, 4}, {0, 0}},
                                      {{0, 0}, {-4, 1}, {-4, -1}, {0, 0}}}));
  std::rotate(petals.begin(), petals.begin() + 1, petals.end());
  EXPECT_EQ(rings_of(closed_trace(petals)),
            (std::vector<WrittenLoop>{{{0, 0}, {1, 4}, {-1, 4}, {0, 0}},
                                      {{0, 0}, {-4, 1}, {-4, -1}, {0, 0}},
                                      {{4, -1}, {4, 1}, {0, 0}, {4, -1}}}));
}

TEST(polygons_of, sides_that_go_back_are_removed) {
  const WrittenLoop ring = {{0, 0}, {4, 0}, {4, 4}, {0, 0}};
  EXPECT_EQ(rings_of(closed_trace({{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}})),
            std::vector<WrittenLoop>{ring});
  EXPECT_EQ(rings_of(closed_trace({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 0}, {0, 0}})),
            std::vector<WrittenLoop>{ring});
}

TEST(polygons_of, plain_loops) {
  EXPECT_TRUE(map::is_plain_loop(WrittenLoop{{0, 0}, {4, 0}, {4, 4}}));
  EXPECT_FALSE(map::is_plain_loop(WrittenLoop{{4, 4}, {4, 0}, {0, 0}}));
  EXPECT_FALSE(map::is_plain_loop(WrittenLoop{{0, 0}, {4, 0}}));
  EXPECT_FALSE(map::is_plain_loop(WrittenLoop{{0, 0}, {4, 0}, {4, 4}, {0, 0}}));
  EXPECT_FALSE(map::is_plain_loop(WrittenLoop{{0, 0}, {4, 0}, {6, 0}, {5, 0}, {4, 4}}));
  WrittenLoop parabola;
  for (std::size_t k = 0; k < map::longest_plain; ++k) {
    const auto x = static_cast<double>(k);
    parabola.push_back({x, x * x / 16});
  }
  EXPECT_TRUE(map::is_plain_loop(parabola));
  parabola.push_back({10, 70});
  EXPECT_FALSE(map::is_plain_loop(parabola));
}

map::Trace trace_of_chains(const std::vector<WrittenLoop>& chains, bool has_north_corners) {
  map::Trace trace;
  for (const WrittenLoop& chain : chains) {
    trace.starts.push_back(trace.points.size());
    for (const LonLat& p : chain) {
      const double pole = p.lat_deg == 90 ? 1 : -1;
      const bool is_at_pole = p.lat_deg == 90 || p.lat_deg == -90;
      trace.points.push_back({is_at_pole ? Point{0, 0, pole} : Point{-1, 0, 0}, p});
    }
  }
  trace.has_north_corners = has_north_corners;
  return trace;
}

// Loops around the corners of the map, each written from the end of a chain along the border to the next start.
TEST(polygons_of, chains_are_joined_along_the_border) {
  using Rings = std::vector<WrittenLoop>;
  // Around the north pole, and around the south pole.
  EXPECT_EQ(rings_of(trace_of_chains({{{-180, 50}, {0, 40}, {180, 50}}}, true)),
            (Rings{{{-180, 50}, {0, 40}, {180, 50}, {180, 90}, {-180, 90}, {-180, 50}}}));
  EXPECT_EQ(rings_of(trace_of_chains({{{180, -50}, {0, -40}, {-180, -50}}}, false)),
            (Rings{{{180, -50}, {0, -40}, {-180, -50}, {-180, -90}, {180, -90}, {180, -50}}}));
  // Across the antimeridian.
  EXPECT_EQ(rings_of(trace_of_chains(
                {{{-180, -10}, {-170, 0}, {-180, 10}}, {{180, 10}, {170, 0}, {180, -10}}}, false)),
            (Rings{{{-180, -10}, {-170, 0}, {-180, 10}, {-180, -10}},
                   {{180, 10}, {170, 0}, {180, -10}, {180, 10}}}));
  // Sectors at the poles.
  EXPECT_EQ(rings_of(trace_of_chains({{{10, 90}, {10, 60}, {20, 60}, {20, 90}}}, false)),
            (Rings{{{10, 90}, {10, 60}, {20, 60}, {20, 90}, {10, 90}}}));
  EXPECT_EQ(rings_of(trace_of_chains({{{20, -90}, {20, -60}, {10, -60}, {10, -90}}}, false)),
            (Rings{{{20, -90}, {20, -60}, {10, -60}, {10, -90}, {20, -90}}}));
  // From pole to pole: half of the map, and the other half, which has the antimeridian in it.
  EXPECT_EQ(rings_of(trace_of_chains({{{20, -90}, {20, 90}}, {{-160, 90}, {-160, -90}}}, false)),
            (Rings{{{20, -90}, {20, 90}, {-160, 90}, {-160, -90}, {20, -90}}}));
  EXPECT_EQ(rings_of(trace_of_chains({{{-160, -90}, {-160, 90}}, {{20, 90}, {20, -90}}}, true)),
            (Rings{{{-160, -90}, {-160, 90}, {-180, 90}, {-180, -90}, {-160, -90}},
                   {{20, 90}, {20, -90}, {180, -90}, {180, 90}, {20, 90}}}));
}

// Nearly all of the map is the outside of nothing.
TEST(polygons_of, nearly_all_of_the_map_is_nothing) {
  const map::Trace trace = trace_of_chains({{{-180, -80}, {0, -89}, {180, -80}}}, true);
  EXPECT_TRUE(rings_of(trace).empty());
  EXPECT_TRUE(map::is_turned_over(trace));
  const std::vector<WrittenLoop> loops = map::drawn_loops(trace);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[1], (WrittenLoop{{-180, 90}, {180, 90}, {180, -90}, {-180, -90}}));
  const map::Trace half = trace_of_chains({{{-180, 10}, {0, -10}, {180, 10}}}, true);
  EXPECT_EQ(rings_of(half).size(), 1U);
  EXPECT_EQ(map::drawn_loops(half).size(), 1U);
}

// All but the strip between longitudes -1 and 1 are two loops; each covers less than half of the map, and both together
// nearly all of it.
TEST(polygons_of, two_loops_are_nearly_all_of_the_map_together) {
  const map::Trace trace = trace_of_chains({{{-1, -90}, {-1, 90}}, {{1, 90}, {1, -90}}}, true);
  EXPECT_TRUE(rings_of(trace).empty());
  EXPECT_TRUE(map::is_turned_over(trace));
  EXPECT_EQ(map::drawn_loops(trace),
            (std::vector<WrittenLoop>{{{-1, -90}, {-1, 90}, {-180, 90}, {-180, -90}},
                                      {{1, 90}, {1, -90}, {180, -90}, {180, 90}},
                                      {{-180, 90}, {180, 90}, {180, -90}, {-180, -90}}}));
}

double total_doubled_area(const std::vector<map::Loop>& loops) {
  double doubled = 0;
  for (const map::Loop& loop : loops) doubled += map::doubled_loop_area(loop);
  return doubled;
}

// What regions leave of the map: all of it, none of it, a frame, and the gap between two.
TEST(outside_loops, are_what_regions_leave) {
  using Regions = std::vector<std::vector<map::Loop>>;
  constexpr double whole = 2 * 360 * 180;
  EXPECT_EQ(total_doubled_area(map::outside_loops(Regions{})), whole);
  EXPECT_TRUE(
      map::outside_loops(Regions{{{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}}}}).empty());
  const map::Loop west = {{-180, -90}, {0, -90}, {0, 90}, {-180, 90}};
  const map::Loop east = {{180, 90}, {1, 90}, {1, -90}, {180, -90}};
  const std::vector<map::Loop> gap = map::outside_loops(Regions{{west}, {east}});
  ASSERT_EQ(gap.size(), 1U);
  EXPECT_EQ(gap[0], (map::Loop{{0, -90}, {1, -90}, {1, 90}, {0, 90}}));
  const map::Loop square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_EQ(map::outside_loops(Regions{{square}}).size(), 2U);
  EXPECT_EQ(total_doubled_area(map::outside_loops(Regions{{square}})), whole - 32);
  for (const map::Loop& corner : {map::Loop{{-180, -90}, {-170, -90}, {-180, -80}},
                                  {{180, -80}, {170, -90}, {180, -90}},
                                  {{180, 90}, {170, 90}, {180, 80}},
                                  {{-180, 90}, {-180, 80}, {-170, 90}}}) {
    const std::vector<map::Loop> left = map::outside_loops(Regions{{corner}});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].size(), 5U);
    EXPECT_EQ(total_doubled_area(left), whole - map::doubled_loop_area(corner));
  }
}

}  // namespace
}  // namespace rondel::test::of_polygon
