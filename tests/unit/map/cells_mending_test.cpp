// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Mending moves the lines of regions within its reach and limits, turns loops over, and keeps slivers across the border of
// the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "map/arc.h"
#include "map/map_plane.h"
#include "map/mending.h"
#include "map/planar_loops.h"
#include "map/polygon.h"
#include "map/region.h"
#include "map/valid_regions.h"
#include "rondel/delaunay.h"
#include "support/planar_check.h"

namespace rondel::test {
namespace {

using map::Loop;

// From rounding to the longest reach, and never by more than four times.
TEST(mending, reach_grows_slowly) {
  EXPECT_EQ(map::reach_of_pass(0), map::merge_distance);
  EXPECT_EQ(map::reach_of_pass(39), map::longest_reach);
  for (int pass = 0; pass < 100; ++pass) {
    const double growth = map::reach_of_pass(pass + 1) / map::reach_of_pass(pass);
    EXPECT_TRUE(growth == 1 || growth == 4) << pass;
    EXPECT_LE(map::reach_of_pass(pass), map::longest_reach);
  }
}

TEST(map_plane, positions_are_near_within_a_millionth_of_a_degree) {
  const LonLat p{12.5, -34.25};
  for (const double share : {0.0, 0.3, 1.0}) {
    const auto away = [&](double distance) {
      return LonLat{p.lon_deg - share * distance, p.lat_deg + (1 - share) * distance};
    };
    EXPECT_TRUE(map::are_near_in_plane(p, away(0.9e-6)));
    EXPECT_FALSE(map::are_near_in_plane(p, away(1.1e-6)));
  }
}

// The tip of a spike leads back to where it came from, beyond that, or not so far.
TEST(map_plane, spikes_are_of_three_kinds) {
  const std::vector<Loop> spiky = {{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}, {0, 4}},
                                   {{0, 0}, {4, 0}, {4, 2}, {4, 6}, {4, 4}, {0, 4}},
                                   {{0, 0}, {4, 0}, {4, 4}, {4, 6}, {4, 1}, {0, 4}}};
  const std::vector<Loop> plain = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                   {{0, 0}, {2, 0}, {4, 0}, {4, 4}, {1, 1}}};
  for (const auto& [loops, expected] : {std::pair(spiky, true), std::pair(plain, false)}) {
    for (Loop loop : loops) {
      for (std::size_t k = 0; k < 2 * loop.size(); ++k) {
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
        if (k == loop.size()) std::ranges::reverse(loop);
        EXPECT_EQ(map::has_spike(loop), expected) << k;
      }
    }
  }
}

bool has_all(const map::PolygonsOfRegion& polygons, const Loop& loop) {
  return std::ranges::all_of(loop, [&](const LonLat& p) {
    return std::ranges::any_of(polygons, [&](const map::PolygonWithHoles& polygon) {
      return std::ranges::find(polygon.rings.front(), p) != polygon.rings.front().end();
    });
  });
}

// More changes than any map has to be allowed, one for each region: none of the given positions moves.
TEST(valid_regions, mend_one_trouble_of_each_of_very_many_regions) {
  std::vector<map::LoopsOfRegion> regions;
  constexpr std::size_t columns = 300;
  for (std::size_t i = 0; i < 5000; ++i) {
    const double lon = 0.1 + static_cast<double>(i % columns);
    const auto row = i / columns;
    const double lat = -80.1 + 3 * static_cast<double>(row);
    const double left = 0.5 * lon - 90;
    // The fourth corner is on the first side.
    regions.push_back({{{left, lat},
                        {left + 0.4, lat},
                        {left + 0.4, lat + 2},
                        {left + 0.2, lat},
                        {left, lat + 2}}});
  }
  const std::vector<map::PolygonsOfRegion> polygons = map::valid_regions(regions, 2);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    ASSERT_EQ(polygons[i].size(), 2U) << i;
    EXPECT_TRUE(has_all(polygons[i], regions[i].front())) << i;
  }
}

std::vector<Point> ring_at(const std::vector<LonLat>& corners) {
  std::vector<Point> ring;
  for (const LonLat& corner : corners) ring.push_back(unit_vector(corner));
  return ring;
}

// A sliver between two regions, whose lines have passed each other since arcs bulge and lines do not. On the side of the pole
// one line leads from end to end, on the other side two, with a corner next to the arc. The one line gets the point opposite
// that corner and no other, and regions elsewhere keep their positions.
TEST(valid_regions, turned_slivers_are_mended_where_they_are) {
  for (const double lat : {30.0, -45.0, 70.0}) {
    const double pole = lat > 0 ? 1 : -1;
    for (const double width : {1e-4, 1e-6, 1e-8}) {
      const LonLat west{10, lat};
      const LonLat east{14, lat};
      LonLat corner = map::lonlat_of(normalized(3.0 * unit_vector(west) + unit_vector(east)), true);
      corner.lat_deg -= pole * width;
      std::vector<Loop> loops = {{west, corner, east},
                                 {west, east, {12, lat + 5 * pole}},
                                 {west, {12, lat - 5 * pole}, east, corner},
                                 {{20.1, lat}, {23.3, lat + 0.7 * pole}, {21.9, lat + 2.3 * pole}}};
      std::vector<map::LoopsOfRegion> regions;
      for (Loop& loop : loops) {
        if (pole < 0) std::ranges::reverse(loop);
        regions.push_back({loop});
      }
      const auto polygons = map::valid_regions(regions, 1);
      const auto where = std::to_string(lat) + ", " + std::to_string(width);
      for (std::size_t i = 0; i < loops.size(); ++i) {
        ASSERT_EQ(polygons[i].size(), 1U) << where;
        EXPECT_EQ(why_invalid({polygons[i][0].rings}), "") << where;
        EXPECT_TRUE(has_all(polygons[i], loops[i])) << where;
        EXPECT_LE(polygons[i][0].rings[0].size(), loops[i].size() + (i < 2 ? 2 : 1)) << where;
      }
      const bool has_opposite = std::ranges::any_of(polygons[1][0].rings[0], [&](const LonLat& p) {
        return map::distance_in_plane(p, corner) < 1.5 * width;
      });
      EXPECT_TRUE(has_opposite) << where;
    }
  }
}

// Slivers across the antimeridian, along it to a pole, and at one: too narrow for their areas to tell them from all but
// themselves, but not for the places where they meet the border of the map.
TEST(map_regions, slivers_across_the_border_seem_to_be_slivers) {
  constexpr double narrow = 3e-11;  // degrees
  std::vector<std::vector<LonLat>> slivers;
  for (const double lat : {-75.0, -20.0, 0.0, 50.0}) {
    slivers.push_back({{179.7, lat}, {-179.7, lat - narrow}, {-179.7, lat + narrow}});
    slivers.push_back({{179.7, lat - narrow}, {-179.7, lat}, {179.7, lat + narrow}});
  }
  for (const double lat : {20.0, 60.0, 75.0}) {
    slivers.push_back({{180 - narrow / 9, lat}, {-180 + narrow / 9, lat}, {0, 90}});
    slivers.push_back({{-180 + narrow / 9, -lat}, {180 - narrow / 9, -lat}, {0, -90}});
  }
  for (const std::vector<LonLat>& corners : slivers) {
    std::vector<Point> ring = ring_at(corners);
    for (const auto border :
         {map::BorderKnowledge::seems_outside, map::BorderKnowledge::seems_inside}) {
      const map::DrawnRegion drawn = map::draw_region(std::array{map::UnitVectors(ring)}, 1e-3);
      EXPECT_EQ(drawn.border, border) << corners[0].lon_deg << ' ' << corners[0].lat_deg;
      double area = 0;
      for (const Loop& loop : drawn.loops) area += map::doubled_loop_area(loop) / 2;
      EXPECT_NEAR(area, 0, 1e-6);
      std::ranges::reverse(ring);
    }
  }
}

// A sector at a pole whose two sides have changed places looks like all but itself: its loops say that it is nearly nothing.
TEST(lonlat_loops, of_turned_sectors_are_nearly_nothing) {
  for (const double lon : {-170.0, 10.0, 95.0}) {
    for (const double pole : {1.0, -1.0}) {
      for (const double width : {1e-9, -1e-9}) {
        const std::vector<Point> ring =
            ring_at({{lon, pole * 60}, {lon + pole * width, pole * 60}, {0, pole * 90}});
        const std::vector<double> tolerances(ring.size(), 0.01);
        double area = 0;
        for (const Loop& loop : map::lonlat_loops(ring, tolerances))
          area += map::doubled_loop_area(loop) / 2;
        EXPECT_NEAR(area, 30 * width, 1e-11) << lon << ' ' << pole;
        double drawn = 0;
        for (const map::LonLatPolygon& polygon : map::lonlat_polygons(ring, tolerances))
          drawn += map::doubled_loop_area(polygon.ring) / 2;
        EXPECT_NEAR(drawn, 0, 1e-6) << lon << ' ' << pole;
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test
