// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parts that maps are made of, one by one: closed lines, rings that turn one way, loops in loops, lines that cross beyond the
// antimeridian.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map/arc.h"
#include "map/cell_map.h"
#include "map/map_plane.h"
#include "map/merged_points.h"
#include "map/planar_loops.h"
#include "map/region.h"
#include "map/ring_area.h"
#include "map/shared_lines.h"
#include "map/trace.h"
#include "map/valid_regions.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/planar_check.h"
#include "support/planar_features.h"
#include "support/random.h"

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

// Tips of narrow cells, where rounding has exchanged the ends of very short arcs.

using Positions = std::set<LonLat, map::InPlane>;

// The positions of points of a diagram that no short arc ends at, but for poles and the antimeridian.
Positions positions_of_points_apart(const Cells& cells) {
  constexpr double apart = 0x1p-29;
  std::set<Index> near;
  for (std::size_t site = 0; site < cells.rings.size(); ++site) {
    const std::span<const Index> ring = cells.rings[site];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Index p = ring[k];
      const Index q = ring[(k + 1) % ring.size()];
      if (map::distance(cells.points[p], cells.points[q]) < apart) near.insert({p, q});
    }
  }
  Positions positions;
  for (const Index i : cells.rings.values) {
    const Point p = map::snapped(cells.points[i]);
    if (!near.contains(i) && !map::is_pole(p) && !(p.y == 0 && p.x < 0))
      positions.insert(map::map_point(p).position);
  }
  return positions;
}

// Expects that the points of a diagram have their positions in its map, bit by bit, unless a short arc ends there.
void expect_points_of_diagram(const Triangulation& triangulation, double tolerance_deg,
                              const std::string& name) {
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, tolerance_deg, {});
  Positions drawn;
  map::CellMap::Pen pen;
  for (std::size_t site = 0; site < triangulation.num_sites(); ++site) {
    for (const map::LonLatPolygon& polygon : map.polygons(site, pen))
      drawn.insert(polygon.ring.begin(), polygon.ring.end());
  }
  const Positions expected = positions_of_points_apart(diagram);
  EXPECT_GT(expected.size(), 3U) << name;
  for (const LonLat& p : expected)
    EXPECT_TRUE(drawn.contains(p)) << name << ": " << p.lon_deg << ' ' << p.lat_deg;
}

// Sites on a circle, but for rounding, have cells of two long sides and tips at the poles of the circle. The short arcs at
// the tips shrink to points, and all other points of the diagram keep their positions, bit by bit.
TEST(cell_map_tips, shrink_and_leave_other_points_where_they_are) {
  for (const auto& [name, seed] :
       {std::pair("meridian_rounded", 2U), std::pair("rotated_circle_0", 1U)}) {
    const SiteSet set = generator(name).make(150, seed);
    expect_points_of_diagram(delaunay(set.sites, {.sphere = set.sphere}), 0.01, name);
  }
}

// The cell of a circle that is so narrow that the lines of both its sides have changed places is mended where it is.
TEST(cell_map_tips, turned_lunes_leave_points_where_they_are) {
  const std::vector<std::vector<Point>> sets = {
      {{0.125, 0, 0}, {-1, 128, 7296}, {-0.125, 16, 912}, {-3, 3, -3}},
      {{-36, 3.0625, 15.375}, {19, 1840, 91}, {38, 3680, 182}, {76, 7360, 364}, {-3, -3, -3}}};
  for (const std::vector<Point>& sites : sets) {
    for (const double tolerance_deg : {5.0, 0.5, 0.1}) {
      expect_points_of_diagram(delaunay(sites, {.model = Model::weighted}), tolerance_deg,
                               std::to_string(tolerance_deg));
    }
  }
}

// So few sites have the tips of the cells above in no time.
TEST(cell_map_tips, of_few_sites_shrink_where_they_are) {
  for (const char* kind : {"rotated_circle_0", "meridian_rounded"}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const SiteSet set = generator(kind).make(10, seed);
      const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
      for (const double tolerance_deg : {0.1, 5.0})
        expect_points_of_diagram(triangulation, tolerance_deg, kind);
    }
  }
  const std::vector<std::vector<Point>> sets = {
      {{0.25, 0, 0}, {-1, 96, 5472}, {-0.25, 24, 1368}, {-3, 3, -3}},
      {{-18, 3.0625, 15.375}, {19, 920, 91}, {38, 1840, 182}, {76, 3680, 364}, {-3, -3, -3}}};
  for (const std::vector<Point>& sites : sets) {
    for (const double tolerance_deg : {5.0, 0.1}) {
      expect_points_of_diagram(delaunay(sites, {.model = Model::weighted}), tolerance_deg,
                               "on one ray");
    }
  }
}

// Points and positions of a map that become one, and those that must not.

// Some places, and many points at most three times merge_distance from each.
std::vector<Point> clusters_of_points(Random& random, std::size_t num_places) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < num_places; ++k) {
    const Point place = random.direction();
    for (std::size_t i = 1 + random.below(40); i-- > 0;) {
      const double reach = 3 * map::merge_distance * random.unit();
      points.push_back(normalized(place + reach * random.direction()));
    }
  }
  for (std::size_t i = points.size(); i-- > 1;) std::swap(points[i], points[random.below(i + 1)]);
  return points;
}

TEST(merged_points, are_those_of_all_pairs) {
  Random random(31);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Point> points = clusters_of_points(random, 1 + random.below(12));
    std::vector<Point> kept;
    std::vector<Point> expected;
    for (const Point& p : points) {
      const auto near = std::ranges::find_if(
          kept, [&](const Point& q) { return map::distance(p, q) <= map::merge_distance; });
      expected.push_back(near == kept.end() ? p : *near);
      if (near == kept.end()) kept.push_back(p);
    }
    EXPECT_EQ(map::merged_points(points), expected);
    EXPECT_LT(kept.size(), points.size());
  }
}

TEST(merged_points, of_points_apart_are_themselves) {
  Random random(32);
  std::vector<Point> points(2000);
  std::ranges::generate(points, [&] { return random.direction(); });
  EXPECT_EQ(map::merged_points(points), points);
  EXPECT_TRUE(map::merged_points({}).empty());
}

// What others have there too stays where it is, though a point nearby comes first.
TEST(merged_points, stay_on_poles_and_antimeridian) {
  const double away = 1.2 * map::merge_distance;
  const std::vector<Point> points = {
      {away, 0, 1}, {0, 0, 1}, {away / 3, away / 3, 1}, {-0.6, away, 0.8}, {-0.6, away / 4, 0.8}};
  const std::vector<Point> merged = map::merged_points(points);
  const Point pole{0, 0, 1};
  const Point on_antimeridian{-0.6, 0, 0.8};
  EXPECT_EQ(merged[0], points[0]);
  EXPECT_EQ(merged[1], pole);
  EXPECT_EQ(merged[2], pole);
  EXPECT_EQ(merged[3], points[3]);
  EXPECT_EQ(merged[4], on_antimeridian);
  const std::vector<Point> beside = {{-0.6, away / 2, 0.8}, {-0.6, -away / 3, 0.8}};
  EXPECT_EQ(map::merged_points(beside), std::vector(2, on_antimeridian));
}

// Next to a pole two points may be near each other and have any longitudes: a line to one of them is not one to the other.
TEST(shared_lines, merge_what_is_near_in_the_plane) {
  constexpr double next_to_pole = 89.9999999999992;
  map::SharedLines lines;
  EXPECT_FALSE(lines.merge({169.5, next_to_pole}, {179, next_to_pole}));
  EXPECT_TRUE(lines.merge({169.5, next_to_pole}, {169.5 + 1e-9, next_to_pole}));
  const LonLat far_south{169.5, 8};
  const LonLat middle{174, 50};
  EXPECT_TRUE(lines.divide(far_south, {10, 20}, middle));
  EXPECT_FALSE(lines.divide(far_south, middle, {10, 20}));  // leads back, and is far from both ends
}

TEST(map_positions, are_not_next_to_zero) {
  for (const double tiny : {1e-300, 1e-200, 1e-100, 1e-45, 1e-22}) {
    EXPECT_EQ(map::lonlat_of({1, tiny, -tiny}, true), (LonLat{0, 0}));
    EXPECT_EQ(map::lonlat_of({0, 1, tiny}, true), (LonLat{90, 0}));
  }
  EXPECT_GT(map::lonlat_of({1, 1e-20, 0}, true).lon_deg, 0);
}

// Along the meridian 0 the region in the west meets itself in two positions, which divide its side one after the other, and
// a notch of another one; the side in the east is longer, and divided first where the next region in the west begins.
TEST(valid_regions, divide_lines_for_all_that_have_got_them) {
  const std::vector<map::LoopsOfRegion> loops = {
      {{{0, 0}, {0, 40}, {-10, 20}}, {{0, 20}, {0, 10}, {-3, 15}}},
      {{{0, 10}, {0, 20}, {-3, 15}}},
      {{{0, 60}, {0, 0}, {10, 30}}},
      {{{0, 40}, {0, 60}, {-10, 50}}}};
  std::vector<PlanarRegion> regions;
  for (const map::PolygonsOfRegion& polygons : map::valid_regions(loops, 1)) {
    PlanarRegion& region = regions.emplace_back();
    for (const map::PolygonWithHoles& polygon : polygons) region.push_back(polygon.rings);
    EXPECT_EQ(why_invalid(region), "");
  }
  ASSERT_EQ(regions[2].size(), 1U);
  EXPECT_EQ(regions[2][0][0].size(), 7U);  // three corners, three on the side, and the first again
  EXPECT_EQ(count_single_sides(regions), 6U);
}

// Sectors of which one corner is hardly farther from the pole than what lies on it, where its longitude is that of the
// antimeridian: the lines that lead there and back have changed places.
TEST(map_regions, sectors_end_next_to_a_pole) {
  for (const double lon : {-172.347, -60.0, 35.0, 120.0}) {
    for (const double pole : {1.0, -1.0}) {
      for (const double x : {-1.9233e-14, -1.6e-14, 1.6e-14, 3e-14}) {
        std::vector<Point> ring = {map::point_at({lon, pole * 25}),
                                   map::point_at({lon + 14.25, pole * 25}),
                                   map::point_at({lon + 14.25, pole * 62}),
                                   {x, -7.7891e-15, pole},
                                   {-9.4e-16, -1.8e-16, pole}};
        if (pole < 0) std::ranges::reverse(ring);
        PlanarRegion region;
        for (const auto& polygon : map::region_polygons(std::array{map::UnitVectors(ring)}, 2e-4))
          region.push_back(polygon.rings);
        EXPECT_EQ(why_invalid(region), "") << lon << ' ' << x;
        double area = 0;
        for (const PlanarPolygon& polygon : region)
          area += map::doubled_loop_area(polygon.front()) / 2;
        EXPECT_NEAR(area, 14.25 * 65, 8) << lon << ' ' << x;
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test
