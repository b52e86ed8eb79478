// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points and positions of a map that become one, and those that must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "map/arc.h"
#include "map/merged_points.h"
#include "map/planar_loops.h"
#include "map/region.h"
#include "map/shared_lines.h"
#include "map/valid_regions.h"
#include "support/planar_check.h"
#include "support/planar_features.h"
#include "support/random.h"

namespace rondel::test {
namespace {

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
