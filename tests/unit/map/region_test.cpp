// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops of regions of boxes and caps: they go once around what is in the region and never around the rest, wherever the
// regions meet the poles and the antimeridian.
#include "map/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "map/planar_loops.h"
#include "map/settled_regions.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test::of_region {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

Point place_on_sphere(double lon_deg, double lat_deg) {
  if (std::abs(lat_deg) == 90) return {0, 0, lat_deg / 90};
  if (std::abs(std::remainder(lon_deg, 360)) == 180)
    return {-std::cos(lat_deg * one_degree), 0, std::sin(lat_deg * one_degree)};
  return {std::cos(lat_deg * one_degree) * std::cos(lon_deg * one_degree),
          std::cos(lat_deg * one_degree) * std::sin(lon_deg * one_degree),
          std::sin(lat_deg * one_degree)};
}

int times_around(const std::vector<std::vector<LonLat>>& loops, const LonLat& p) {
  int times = 0;
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const LonLat& a = loop[k];
      const LonLat& b = loop[(k + 1) % loop.size()];
      if ((a.lat_deg > p.lat_deg) == (b.lat_deg > p.lat_deg)) continue;
      const double turn = (b.lon_deg - a.lon_deg) * (p.lat_deg - a.lat_deg) -
                          (b.lat_deg - a.lat_deg) * (p.lon_deg - a.lon_deg);
      if (b.lat_deg > a.lat_deg && turn > 0) ++times;
      if (b.lat_deg < a.lat_deg && turn < 0) --times;
    }
  }
  return times;
}

std::vector<std::vector<LonLat>> loops_of_rings(const std::vector<std::vector<Point>>& rings) {
  std::vector<map::UnitVectors> spans;
  for (const std::vector<Point>& ring : rings) spans.emplace_back(ring);
  return map::region_loops(spans, 1e-4);
}

void turn_around(std::vector<std::vector<Point>>& rings) {
  for (std::vector<Point>& ring : rings) std::ranges::reverse(ring);
}

// A box between meridians and parallels in multiples of 15 degrees.
struct Box {
  int west;
  int east;  // up to 345 degrees more
  int south;
  int north;

  [[nodiscard]] bool has(const LonLat& p) const {
    const double away = p.lon_deg - west - 360 * std::floor((p.lon_deg - west) / 360);
    return away < east - west && p.lat_deg > south && p.lat_deg < north;
  }

  [[nodiscard]] std::vector<Point> ring() const {
    std::vector<Point> ring;
    const auto add = [&](int lon, int lat) {
      const Point p = place_on_sphere(lon > 180 ? lon - 360 : lon, lat);
      if (ring.empty() || ring.back() != p) ring.push_back(p);
    };
    for (int lon = west; lon < east; ++lon) add(lon, south);
    for (int lat = south; lat < north; lat += 5) add(east, lat);
    for (int lon = east; lon > west; --lon) add(lon, north);
    for (int lat = north; lat > south; lat -= 5) add(west, lat);
    if (ring.back() == ring.front()) ring.pop_back();
    return ring;
  }
};

// True if there is room between two boxes, except at a pole that both reach.
bool are_apart(const Box& a, const Box& b) {
  if (a.north < b.south || b.north < a.south) return true;
  const int ahead = ((b.west - a.west) % 360 + 360) % 360;
  return ahead > a.east - a.west && ahead + b.east - b.west < 360;
}

// The sides along parallels are arcs of one degree, which are less than 0.003 degrees from them.
TEST(map_regions, boxes_and_all_but_boxes) {
  Random random(74);
  const auto times_15 = [&](int low, int high) {
    return 15 * (low + static_cast<int>(random.below(static_cast<std::uint64_t>(high - low + 1))));
  };
  for (int round = 0; round < 400; ++round) {
    std::vector<Box> boxes;
    for (int k = 0; k < 12; ++k) {
      Box box{times_15(-12, 11), 0, times_15(-6, 5), 0};
      box.east = box.west + times_15(1, round % 4 == 0 ? 23 : 6);
      box.north = std::min(box.south + times_15(1, 11), 90);
      if (random.below(3) == 0) box.north = 90;
      if (std::ranges::all_of(boxes, [&](const Box& other) { return are_apart(box, other); }))
        boxes.push_back(box);
      if (k == round % 12) break;
    }
    std::vector<std::vector<Point>> rings;
    for (const Box& box : boxes) rings.push_back(box.ring());
    const bool is_all_but = random.below(2) == 0;
    if (is_all_but) turn_around(rings);
    const auto loops = loops_of_rings(rings);
    for (int k = 0; k < 40; ++k) {
      const LonLat p{7.5 + times_15(-12, 11) + random.unit(),
                     7.5 + times_15(-6, 5) + random.unit()};
      const bool is_inside = std::ranges::any_of(boxes, [&](const Box& box) { return box.has(p); });
      EXPECT_EQ(times_around(loops, p), is_inside != is_all_but ? 1 : 0)
          << round << " at " << p.lon_deg << ' ' << p.lat_deg;
    }
  }
}

struct Cap {
  Point center;
  double radius;

  [[nodiscard]] std::vector<Point> ring() const {
    const Point u = normalized(cross(center, Point{0.3, 0.5, -0.2}));
    const Point v = cross(center, u);
    std::vector<Point> ring;
    constexpr int corners = 90;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      ring.push_back(normalized(std::cos(radius) * center +
                                std::sin(radius) * (std::cos(angle) * u + std::sin(angle) * v)));
    }
    return ring;
  }
};

// A cap, a ring between two caps with one center, and all but two caps, with centers on and beside the poles and the
// antimeridian.
TEST(map_regions, caps_and_what_is_between_them) {
  Random random(75);
  for (int round = 0; round < 200; ++round) {
    const std::array<LonLat, 5> centers{{{360 * random.unit() - 180, 180 * random.unit() - 90},
                                         {0, 90},
                                         {0, -90},
                                         {180, 160 * random.unit() - 80},
                                         {0, 160 * random.unit() - 80}}};
    const LonLat& at = centers[random.below(centers.size())];
    const Cap outer{place_on_sphere(at.lon_deg, at.lat_deg), 0.3 + 1.1 * random.unit()};
    const bool is_opposite = random.below(2) == 0;
    const Cap inner{is_opposite ? -1.0 * outer.center : outer.center, 0.25 * random.unit() + 0.01};
    std::vector<std::vector<Point>> rings = {outer.ring()};
    const bool has_two = random.below(3) > 0;
    if (has_two) rings.push_back(inner.ring());
    // Rings are outer to the left and inner to the right, or both to the left where they are opposite: that is the union.
    if (has_two && !is_opposite) std::ranges::reverse(rings[1]);
    const bool is_all_but = random.below(2) == 0;
    if (is_all_but) turn_around(rings);
    const auto loops = loops_of_rings(rings);
    for (int k = 0; k < 40; ++k) {
      const LonLat p{360 * random.unit() - 180, 180 * random.unit() - 90};
      const Point v = place_on_sphere(p.lon_deg, p.lat_deg);
      const auto depth = [&](const Cap& cap) {
        return cap.radius - std::acos(std::clamp(dot(v, cap.center), -1.0, 1.0));
      };
      if (std::abs(depth(outer)) < 2e-3 || std::abs(depth(inner)) < 2e-3) continue;
      bool is_inside = depth(outer) > 0;
      if (has_two) is_inside = is_inside != (depth(inner) > 0);
      EXPECT_EQ(times_around(loops, p), is_inside != is_all_but ? 1 : 0)
          << round << " at " << p.lon_deg << ' ' << p.lat_deg;
    }
  }
}

// True if a loop has the expected positions within half a degree, beginning anywhere.
bool is_nearly(const std::vector<LonLat>& loop, const std::vector<LonLat>& expected) {
  if (loop.size() != expected.size()) return false;
  for (std::size_t first = 0; first < loop.size(); ++first) {
    bool is_same = true;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const LonLat& p = loop[(first + k) % loop.size()];
      is_same = is_same && std::abs(p.lon_deg - expected[k].lon_deg) < 0.5 &&
                std::abs(p.lat_deg - expected[k].lat_deg) < 0.5;
    }
    if (is_same) return true;
  }
  return false;
}

std::vector<std::vector<LonLat>> coarse_loops(const std::vector<std::vector<LonLat>>& corners) {
  std::vector<std::vector<Point>> rings;
  for (const std::vector<LonLat>& some : corners) {
    std::vector<Point>& ring = rings.emplace_back();
    for (const LonLat& p : some) ring.push_back(place_on_sphere(p.lon_deg, p.lat_deg));
  }
  std::vector<map::UnitVectors> spans(rings.begin(), rings.end());
  return map::region_loops(spans, 4);
}

// All but three sectors at a pole: the loop goes along the border from each to the next one, and around the map.
TEST(map_regions, all_but_sectors_at_a_pole) {
  std::vector<std::vector<LonLat>> sectors = {{{20, 60}, {10, 60}, {0, 90}},
                                              {{60, 60}, {50, 60}, {0, 90}},
                                              {{-90, 60}, {-100, 60}, {0, 90}}};
  std::vector<LonLat> expected = {
      {20, 90},   {20, 60},    {10, 60},   {10, 90},  {-90, 90}, {-90, 60}, {-100, 60}, {-100, 90},
      {-180, 90}, {-180, -90}, {180, -90}, {180, 90}, {60, 90},  {60, 60},  {50, 60},   {50, 90}};
  const auto north = coarse_loops(sectors);
  ASSERT_EQ(north.size(), 1U);
  EXPECT_TRUE(is_nearly(north[0], expected));
  const auto mirror = [](std::vector<LonLat>& positions) {
    for (LonLat& p : positions) p.lat_deg = -p.lat_deg;
    std::ranges::reverse(positions);
  };
  std::ranges::for_each(sectors, mirror);
  mirror(expected);
  const auto south = coarse_loops(sectors);
  ASSERT_EQ(south.size(), 1U);
  EXPECT_TRUE(is_nearly(south[0], expected));
}

// Three boxes across the antimeridian have two loops each; all but them has one.
TEST(map_regions, all_but_boxes_at_the_antimeridian) {
  std::vector<std::vector<LonLat>> boxes;
  std::vector<LonLat> west;
  std::vector<LonLat> east;
  for (const double lat : {40.0, 0.0, -40.0}) {
    boxes.push_back({{170, lat - 5}, {170, lat + 5}, {-170, lat + 5}, {-170, lat - 5}});
    for (const LonLat& p :
         {LonLat{-180, lat + 5}, {-170, lat + 5}, {-170, lat - 5}, {-180, lat - 5}}) {
      west.push_back(p);
      east.push_back({-p.lon_deg, -p.lat_deg});
    }
  }
  std::vector<LonLat> expected = west;
  expected.insert(expected.end(), {{-180, -90}, {180, -90}});
  expected.insert(expected.end(), east.begin(), east.end());
  expected.insert(expected.end(), {{180, 90}, {-180, 90}});
  const auto loops = coarse_loops(boxes);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_TRUE(is_nearly(loops[0], expected));
  for (std::vector<LonLat>& box : boxes) std::ranges::reverse(box);
  EXPECT_EQ(coarse_loops(boxes).size(), 6U);
}

TEST(map_regions, without_rings_are_the_whole_map) {
  const std::vector<LonLat> border = {{-180, -90}, {180, -90}, {180, 90}, {-180, 90}};
  EXPECT_EQ(map::border_loop(), border);
  EXPECT_EQ(map::region_loops({}, 0.1), std::vector<std::vector<LonLat>>{border});
  EXPECT_EQ(map::draw_region({}, 0.1).border, map::BorderKnowledge::is_known);
}

// The ring of a place and back encloses nothing.
TEST(map_regions, rings_of_two_points_are_nothing) {
  const std::vector<Point> ring = {place_on_sphere(10, 0), place_on_sphere(20, 0),
                                   place_on_sphere(20, 10)};
  const std::vector<Point> line = {place_on_sphere(40, 0), place_on_sphere(60, 30)};
  EXPECT_EQ(loops_of_rings({ring, line}), loops_of_rings({ring}));
  EXPECT_TRUE(loops_of_rings({line}).empty());
  const std::vector<map::UnitVectors> spans = {line};
  EXPECT_EQ(map::draw_region(spans, 0.1).border, map::BorderKnowledge::seems_outside);
}

// A triangle and all but it, in the middle of the map, across the antimeridian and around a pole. The tolerance is large, so
// that the loops are those of the corners.
TEST(map_regions, of_a_triangle_and_all_but_it) {
  const std::vector<LonLat> corners = {{10, 0}, {20, 0}, {20, 10}};
  const auto inside = coarse_loops({corners});
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_TRUE(is_nearly(inside[0], corners));
  const auto outside = coarse_loops({{corners[2], corners[1], corners[0]}});
  ASSERT_EQ(outside.size(), 2U);
  EXPECT_TRUE(is_nearly(outside[0], {corners[2], corners[1], corners[0]}));
  EXPECT_EQ(outside[1], map::border_loop());
  const std::vector<LonLat> around_pole = {{0, 80}, {120, 80}, {-120, 80}};
  const auto cap = coarse_loops({around_pole});
  ASSERT_EQ(cap.size(), 1U);
  EXPECT_EQ(std::ranges::count(cap[0], LonLat{180, 90}), 1);
  EXPECT_EQ(std::ranges::count(cap[0], LonLat{-180, 90}), 1);
  EXPECT_EQ(times_around(cap, {33, 89}), 1);
  EXPECT_EQ(times_around(cap, {33, -89}), 0);
  const auto rest = coarse_loops({{around_pole[2], around_pole[1], around_pole[0]}});
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(std::ranges::count(rest[0], LonLat{180, -90}), 1);
  EXPECT_EQ(times_around(rest, {33, 89}), 0);
  EXPECT_EQ(times_around(rest, {33, -89}), 1);
}

TEST(line_parts, are_cut_at_the_antimeridian) {
  const std::vector<Point> line = {place_on_sphere(170, 0), place_on_sphere(-170, 0),
                                   place_on_sphere(-170, 0), place_on_sphere(-160, 0)};
  const auto parts = map::line_parts(line, false, 1);
  ASSERT_EQ(parts.size(), 2U);
  ASSERT_EQ(parts[0].size(), 2U);
  ASSERT_EQ(parts[1].size(), 3U);
  EXPECT_NEAR(parts[0][0].lon_deg, 170, 1e-12);
  EXPECT_EQ(parts[0][1].lon_deg, 180);
  EXPECT_EQ(parts[1][0].lon_deg, -180);
  EXPECT_NEAR(parts[1][2].lon_deg, -160, 1e-12);
  EXPECT_TRUE(map::line_parts(std::span(line).first(1), false, 1).empty());
  EXPECT_TRUE(map::line_parts(std::span(line).subspan(1, 2), false, 1).empty());
  EXPECT_TRUE(map::line_parts(std::span(line).first(3), true, 1).empty());
  EXPECT_EQ(map::line_parts(std::span(line).first(2), false, 1).size(), 2U);
}

double area_of_regions(const std::vector<map::PolygonWithHoles>& polygons) {
  double doubled = 0;
  for (const map::PolygonWithHoles& polygon : polygons) {
    for (const auto& ring : polygon.rings) doubled += map::doubled_loop_area(ring);
  }
  return doubled / 2;
}

// Two squares that overlap, in whole numbers: each face goes to the first of the regions that have it.
TEST(settled_regions, of_two_squares_that_overlap) {
  const std::vector<std::vector<map::Loop>> loops = {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}},
                                                     {{{2, 1}, {7, 1}, {7, 3}, {2, 3}}},
                                                     {{{0, 0}, {0, 4}, {4, 4}, {4, 0}}}};
  std::vector<std::vector<map::DirectedLine>> sides;
  for (const auto& own : loops) sides.push_back(map::sides_of_loops(own));
  ASSERT_EQ(sides[0].size(), 4U);
  EXPECT_EQ(sides[0][3], (map::DirectedLine{{0, 4}, {0, 0}}));
  sides.pop_back();
  for (const unsigned threads : {1U, 2U}) {
    const auto regions = map::settled_regions(sides, threads);
    EXPECT_EQ(area_of_regions(regions[0]), 16);
    EXPECT_EQ(area_of_regions(regions[1]), 6);
    EXPECT_EQ(map::settled_convex_regions(sides, threads)[1][0].ring.size(), 5U);
  }
}

// A frame with a hole. What touches the hole's border from inside goes, what is beside it stays, in each direction.
TEST(settled_regions, fill_a_hole_and_keep_what_is_beside_it) {
  const map::Loop frame = {{0, 0}, {12, 0}, {12, 12}, {0, 12}};
  const map::Loop hole = {{6, 2}, {2, 6}, {6, 10}, {10, 6}};
  const std::vector<std::vector<map::Loop>> loops = {
      {frame, hole},
      {{{6, 4}, {8, 6}, {6, 8}, {4, 6}}},       // in the hole
      {{{6, 2}, {7, 4}, {5, 4}}},               // with a corner of the hole
      {{{2, 6}, {3, 5.5}, {3, 6.5}}},           // with another one
      {{{13, 5}, {15, 5}, {15, 7}, {13, 7}}},   // in the east
      {{{-3, 5}, {-1, 5}, {-1, 7}, {-3, 7}}},   // in the west
      {{{5, 13}, {7, 13}, {7, 15}, {5, 15}}},   // in the north
      {{{5, -3}, {7, -3}, {7, -1}, {5, -1}}}};  // in the south
  std::vector<std::vector<map::DirectedLine>> sides;
  for (const auto& own : loops) sides.push_back(map::sides_of_loops(own));
  const auto regions = map::settled_convex_regions(sides, 1);
  const std::array<std::size_t, 8> expected{1, 0, 0, 0, 1, 1, 1, 1};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(regions[i].size(), expected[i]) << i;
}

// A point that a file gives with up to 12 decimals is written with them, and one that is moved by rounding with up to 9.
TEST(region, lines_have_the_decimals_of_their_file) {
  Random random(32);
  double power = 1;
  for (int decimals = 0; decimals <= 12; ++decimals, power *= 10) {
    for (int i = 0; i < 100; ++i) {
      std::vector<LonLat> given;
      for (int k = 0; k < 3; ++k) {
        given.push_back({std::rint(170 * random.signed_unit() * power) / power,
                         std::rint(79 * random.signed_unit() * power) / power});
      }
      std::vector<Point> points = unit_vectors(given);
      if (decimals <= 9) {
        for (Point& p : points) p = normalized(3 * p);
      }
      std::vector<LonLat> found;
      for (const auto& part : map::line_parts(points, false, 4)) {
        std::ranges::copy_if(part, std::back_inserter(found), [](const LonLat& p) {
          return std::abs(p.lon_deg) < 180 && std::abs(p.lat_deg) < 90;
        });
      }
      EXPECT_EQ(found, given) << decimals;
    }
  }
  const std::vector<Point> on_meridian = {unit_vector({20, 5.5}),
                                          unit_vector({20, 5.123456789012345})};
  EXPECT_EQ(map::line_parts(on_meridian, false, 4).front().back().lon_deg, 20);
}

}  // namespace
}  // namespace rondel::test::of_region
