// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parts that maps are made of, one by one: closed lines, rings that turn one way, loops in loops, lines that cross beyond the
// antimeridian.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "map/arc.h"
#include "map/crossing_lines.h"
#include "map/nested_loops.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "rondel/delaunay.h"

namespace rondel::test {
namespace {

std::vector<Point> ring_of(const std::vector<LonLat>& corners) {
  std::vector<Point> ring;
  for (const LonLat& corner : corners) ring.push_back(unit_vector(corner));
  return ring;
}

TEST(line_parts, of_a_closed_line_have_each_of_its_corners) {
  const std::vector<Point> ring = ring_of({{10, 10}, {11, 10}, {11, 11}, {10.5, 12}});
  const auto parts = map::line_parts(ring, true, 1);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].size(), ring.size() + 1);
  EXPECT_EQ(parts[0].front(), parts[0].back());
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(parts[0][k].lon_deg, map::lonlat_of(ring[k], false).lon_deg, 1e-12);
    EXPECT_NEAR(parts[0][k].lat_deg, map::lonlat_of(ring[k], false).lat_deg, 1e-12);
  }
}

TEST(ring_area, tells_which_way_small_rings_go) {
  // A square, and two arrowheads whose first corner is the notch or beside it.
  for (const auto& corners : {std::vector<LonLat>{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                              {{2, 1}, {4, 0}, {2, 6}, {0, 0}},
                              {{0, 0}, {2, 1}, {4, 0}, {2, 6}},
                              {{2, 6}, {0, 0}, {2, 1}, {4, 0}}}) {
    std::vector<Point> ring = ring_of(corners);
    EXPECT_FALSE(map::is_clockwise(ring));
    std::ranges::reverse(ring);
    EXPECT_TRUE(map::is_clockwise(ring));
  }
}

TEST(ring_area, is_surely_larger_only_where_it_is) {
  std::vector<Point> ring = ring_of({{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  const double area = map::area_on_left(ring);
  EXPECT_NEAR(area, 0.12, 0.01);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_TRUE(map::is_surely_larger(ring, area / 20));
    EXPECT_FALSE(map::is_surely_larger(ring, area));
    std::ranges::reverse(ring);
  }
  // One triangle goes the other way: nothing is sure.
  EXPECT_FALSE(map::is_surely_larger(ring_of({{4, 0}, {2, 6}, {0, 0}, {2, 1}}), 0));
}

// Holes belong to the smallest ring around them, whatever corner it begins with.
TEST(owners_of, rings_in_rings_are_the_smallest_around_holes) {
  const std::vector<std::vector<LonLat>> loops = {{{0, 0}, {100, 0}, {0, 80}},
                                                  {{10, 10}, {20, 10}, {20, 20}, {10, 20}},
                                                  {{5, 5}, {5, 30}, {30, 30}, {30, 5}},
                                                  {{14, 14}, {14, 16}, {16, 16}, {16, 14}}};
  EXPECT_EQ(map::owners_of(loops, 2), (std::vector<std::size_t>{0, 1, 0, 1}));
  for (std::size_t first = 1; first < 3; ++first) {
    auto turned = loops;
    std::rotate(turned[0].begin(), turned[0].begin() + static_cast<std::ptrdiff_t>(first),
                turned[0].end());
    EXPECT_EQ(map::owners_of(turned, 2), (std::vector<std::size_t>{0, 1, 0, 1}));
  }
}

map::MapPoint on_map(const LonLat& position) { return {unit_vector(position), position}; }

// West of the antimeridian, east of it and west again: what the first and the third part have in common is found.
TEST(crossing_lines, are_found_beyond_the_antimeridian_and_back) {
  map::Trace trace;
  for (const LonLat& p :
       {LonLat{160, 0}, {180, 0}, {-180, 0}, {-170, 5}, {-180, 10}, {180, 10}, {165, -5}}) {
    trace.points.push_back(on_map(p));
  }
  trace.starts = {0, 2, 5};
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  Pairs found = map::crossing_lines(trace);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(std::minmax(found[0].first, found[0].second), std::minmax<std::size_t>(0, 5));
  for (map::MapPoint& p : trace.points) p = on_map({-p.position.lon_deg, p.position.lat_deg});
  found = map::crossing_lines(trace);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(std::minmax(found[0].first, found[0].second), std::minmax<std::size_t>(0, 5));
}

}  // namespace
}  // namespace rondel::test
