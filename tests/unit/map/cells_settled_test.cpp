// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions whose lines cross: snap rounding by integers, and whose each place is by windings of sampled places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "map/map_grid.h"
#include "map/settled_regions.h"
#include "map/snap_rounding.h"
#include "support/planar_check.h"
#include "support/random.h"

namespace rondel::test {
namespace {

constexpr double step_of_grid = 0x1p-44;

using map::DirectedLine;
using Sides = std::vector<std::vector<DirectedLine>>;

std::vector<DirectedLine> sides_of_loop(const std::vector<LonLat>& loop) {
  std::vector<DirectedLine> sides;
  for (std::size_t k = 0; k < loop.size(); ++k)
    sides.push_back({loop[k], loop[(k + 1) % loop.size()]});
  return sides;
}

// Multiples of `step` next to a corner.
LonLat random_position(Random& random, const LonLat& corner, double step, std::uint64_t size) {
  return {corner.lon_deg + step * static_cast<double>(random.below(size)),
          corner.lat_deg + step * static_cast<double>(random.below(size))};
}

// In grid steps from the corner, exact.
struct StepPlace {
  std::int64_t x;
  std::int64_t y;
  friend bool operator==(const StepPlace&, const StepPlace&) = default;
};

StepPlace in_steps(const LonLat& p, const LonLat& corner) {
  return {static_cast<std::int64_t>((p.lon_deg - corner.lon_deg) / step_of_grid),
          static_cast<std::int64_t>((p.lat_deg - corner.lat_deg) / step_of_grid)};
}

std::int64_t turn_of(const StepPlace& a, const StepPlace& b, const StepPlace& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_strictly_on(const StepPlace& a, const StepPlace& b, const StepPlace& p) {
  return turn_of(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) <= 0 &&
         (p.y - a.y) * (p.y - b.y) <= 0 && !(p == a) && !(p == b);
}

bool meet_inside(const StepPlace& a, const StepPlace& b, const StepPlace& c, const StepPlace& d) {
  const auto sign = [](std::int64_t number) { return number > 0 ? 1 : (number < 0 ? -1 : 0); };
  if (sign(turn_of(a, b, c)) * sign(turn_of(a, b, d)) < 0 &&
      sign(turn_of(c, d, a)) * sign(turn_of(c, d, b)) < 0)
    return true;
  return is_strictly_on(a, b, c) || is_strictly_on(a, b, d) || is_strictly_on(c, d, a) ||
         is_strictly_on(c, d, b);
}

TEST(snap_rounding, lines_meet_in_common_ends_only) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const std::uint64_t size = 4 + random.below(60);
    const LonLat corner{round % 2 == 0 ? 179.5 : -33, round % 3 == 0 ? -89.5 : 12};
    Sides sides(3);
    for (std::vector<DirectedLine>& own : sides) {
      std::vector<LonLat> loop;
      for (int k = 0; k < 8; ++k)
        loop.push_back(random_position(random, corner, step_of_grid, size));
      own = sides_of_loop(loop);
    }
    const std::vector<map::NodedLine> lines = map::snap_rounded(sides);
    for (const map::NodedLine& line : lines) {
      const StepPlace a = in_steps(line.from, corner);
      const StepPlace b = in_steps(line.to, corner);
      EXPECT_EQ(line.from.lon_deg, corner.lon_deg + step_of_grid * static_cast<double>(a.x));
      for (const map::NodedLine& other : lines) {
        EXPECT_FALSE(meet_inside(a, b, in_steps(other.from, corner), in_steps(other.to, corner)))
            << round;
      }
    }
  }
}

TEST(snap_rounding, moves_nothing_by_more_than_a_step) {
  Random random(12);
  for (int round = 0; round < 50; ++round) {
    Sides sides(1);
    std::vector<LonLat> loop;
    for (int k = 0; k < 12; ++k)
      loop.push_back({360 * random.unit() - 180, 180 * random.unit() - 90});
    sides[0] = sides_of_loop(loop);
    for (const map::NodedLine& line : map::snap_rounded(sides)) {
      const LonLat middle{std::midpoint(line.from.lon_deg, line.to.lon_deg),
                          std::midpoint(line.from.lat_deg, line.to.lat_deg)};
      const bool is_near = std::ranges::any_of(sides[0], [&](const DirectedLine& side) {
        const double dx = side.to.lon_deg - side.from.lon_deg;
        const double dy = side.to.lat_deg - side.from.lat_deg;
        const double along = ((middle.lon_deg - side.from.lon_deg) * dx +
                              (middle.lat_deg - side.from.lat_deg) * dy) /
                             (dx * dx + dy * dy);
        const double away = ((middle.lon_deg - side.from.lon_deg) * dy -
                             (middle.lat_deg - side.from.lat_deg) * dx) /
                            std::hypot(dx, dy);
        return along > -1e-12 && along < 1 + 1e-12 && std::abs(away) < 4 * step_of_grid;
      });
      EXPECT_TRUE(is_near);
    }
  }
}

TEST(map_grid, pixels_are_half_open) {
  const map::GridPlace center{10, 20};
  EXPECT_TRUE(map::meets_pixel({9, 10}, {9, 30}, center));     // the western side
  EXPECT_FALSE(map::meets_pixel({11, 10}, {11, 30}, center));  // the eastern one
  EXPECT_TRUE(map::meets_pixel({0, 19}, {30, 19}, center));
  EXPECT_FALSE(map::meets_pixel({0, 21}, {30, 21}, center));
  EXPECT_TRUE(map::meets_pixel({8, 20}, {10, 18}, center));    // the corner in the south west
  EXPECT_FALSE(map::meets_pixel({10, 22}, {12, 20}, center));  // in the north east
  EXPECT_FALSE(map::meets_pixel({8, 20}, {10, 22}, center));
  EXPECT_FALSE(map::meets_pixel({10, 18}, {12, 20}, center));
  EXPECT_FALSE(map::meets_pixel({0, 0}, {5, 10}, center));
  EXPECT_TRUE(map::meets_pixel({0, 0}, {10, 20}, center));
}

// Looks at every point of the line from a to b at which a coordinate may be that of a border of the
// pixel [-1, 1) x [-1, 1), and at points between all of these.
bool has_a_point_in_pixel(const map::GridPlace& a, const map::GridPlace& b) {
  const std::int64_t dx = b.x - a.x;
  const std::int64_t dy = b.y - a.y;
  const std::int64_t n =
      2 * std::max<std::int64_t>(std::abs(dx), 1) * std::max<std::int64_t>(std::abs(dy), 1);
  const auto is_within = [&](std::int64_t start, std::int64_t step, std::int64_t k) {
    const std::int64_t place = n * start + k * step;
    return place >= -n && place < n;
  };
  for (std::int64_t k = 0; k <= n; ++k) {
    if (is_within(a.x, dx, k) && is_within(a.y, dy, k)) return true;
  }
  return false;
}

TEST(map_grid, all_short_lines_meet_the_pixels_in_which_they_have_a_point) {
  constexpr std::int64_t far = 3;
  std::vector<map::GridPlace> places;
  for (std::int64_t x = -far; x <= far; ++x) {
    for (std::int64_t y = -far; y <= far; ++y) places.push_back({x, y});
  }
  for (const map::GridPlace& a : places) {
    for (const map::GridPlace& b : places) {
      if (a == b) continue;
      EXPECT_EQ(map::meets_pixel(a, b, {0, 0}), has_a_point_in_pixel(a, b))
          << a.x << ' ' << a.y << " to " << b.x << ' ' << b.y;
    }
  }
}

TEST(map_grid, rounds_crossings_to_the_pixel_that_has_them) {
  Random random(13);
  for (int round = 0; round < 2000; ++round) {
    const auto place = [&] {
      return map::GridPlace{2 * static_cast<std::int64_t>(random.below(80)) - 80,
                            2 * static_cast<std::int64_t>(random.below(80)) - 80};
    };
    const map::GridPlace a = place();
    const map::GridPlace b = place();
    const map::GridPlace c = place();
    const map::GridPlace d = place();
    if (map::turn_on_grid(a, b, c) * map::turn_on_grid(a, b, d) >= 0 ||
        map::turn_on_grid(c, d, a) * map::turn_on_grid(c, d, b) >= 0)
      continue;
    const map::GridPlace found = map::crossing_pixel(a, b, c, d);
    const auto cross = [](const map::GridPlace& u, const map::GridPlace& v) {
      return u.x * v.y - u.y * v.x;
    };
    const map::GridPlace u{b.x - a.x, b.y - a.y};
    const map::GridPlace v{d.x - c.x, d.y - c.y};
    std::int64_t whole = cross(u, v);
    std::int64_t part = cross({c.x - a.x, c.y - a.y}, v);
    if (whole < 0) {
      whole = -whole;
      part = -part;
    }
    // found - 1 <= a + u part / whole < found + 1
    for (const auto& [at, from, along] :
         {std::array{found.x, a.x, u.x}, std::array{found.y, a.y, u.y}}) {
      const std::int64_t scaled = from * whole + along * part;
      EXPECT_LE((at - 1) * whole, scaled);
      EXPECT_LT(scaled, (at + 1) * whole);
      EXPECT_EQ(at % 2, 0);
    }
  }
}

int winding_around(const std::vector<DirectedLine>& sides, const LonLat& p) {
  int winding = 0;
  for (const auto& [a, b] : sides) {
    const double turn = (b.lon_deg - a.lon_deg) * (p.lat_deg - a.lat_deg) -
                        (b.lat_deg - a.lat_deg) * (p.lon_deg - a.lon_deg);
    if (a.lat_deg <= p.lat_deg && b.lat_deg > p.lat_deg && turn > 0) ++winding;
    if (a.lat_deg > p.lat_deg && b.lat_deg <= p.lat_deg && turn < 0) --winding;
  }
  return winding;
}

bool is_near_a_side(const Sides& sides, const LonLat& p) {
  for (const auto& own : sides) {
    for (const auto& [a, b] : own) {
      const double dx = b.lon_deg - a.lon_deg;
      const double dy = b.lat_deg - a.lat_deg;
      const double away = (p.lon_deg - a.lon_deg) * dy - (p.lat_deg - a.lat_deg) * dx;
      if (std::abs(away) < 1e-6 * (std::abs(dx) + std::abs(dy))) return true;
    }
  }
  return false;
}

bool has_inside(const PlanarRegion& region, const LonLat& p) {
  int winding = 0;
  for (const PlanarPolygon& polygon : region) {
    for (const PlanarRing& ring : polygon) {
      std::vector<DirectedLine> sides;
      for (std::size_t k = 0; k + 1 < ring.size(); ++k) sides.push_back({ring[k], ring[k + 1]});
      winding += winding_around(sides, p);
    }
  }
  return winding != 0;
}

std::vector<PlanarRegion> settled(const Sides& sides) {
  std::vector<PlanarRegion> regions;
  for (const auto& polygons : map::settled_regions(sides, 1)) {
    PlanarRegion& region = regions.emplace_back();
    for (const map::PolygonWithHoles& polygon : polygons) region.push_back(polygon.rings);
  }
  return regions;
}

// The first of the regions that go around a place most often, once at least; the number of regions if none does.
std::size_t expected_region(const Sides& sides, const LonLat& p) {
  std::size_t expected = sides.size();
  int most = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const int winding = winding_around(sides[i], p);
    if (winding <= most) continue;
    most = winding;
    expected = i;
  }
  return expected;
}

// By a raster much finer than the loops.
bool has_region_without_place(const Sides& sides) {
  std::vector<bool> has(sides.size() + 1);
  for (int x = 0; x < 240; ++x) {
    for (int y = 0; y < 240; ++y)
      has[expected_region(sides, {-10.01 + x / 20.0, 30.01 + y / 20.0})] = true;
  }
  return std::find(has.begin(), has.end() - 1, false) != has.end() - 1;
}

TEST(settled_regions, give_each_place_to_the_region_that_goes_around_it_most_often) {
  Random random(14);
  for (int round = 0; round < 60; ++round) {
    Sides sides(1 + random.below(4));
    for (auto& own : sides) {
      for (std::size_t loops = 1 + random.below(2); loops-- > 0;) {
        std::vector<LonLat> loop;
        for (std::size_t k = 3 + random.below(5); k-- > 0;)
          loop.push_back(random_position(random, {-10, 30}, 1, 12));
        const auto more = sides_of_loop(loop);
        own.insert(own.end(), more.begin(), more.end());
      }
    }
    const std::vector<PlanarRegion> regions = settled(sides);
    for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "") << round;
    // A region that goes nowhere around most often may have got what others have twice.
    const bool has_lost = has_region_without_place(sides);
    for (int k = 0; k < 300; ++k) {
      const LonLat p{-10 + 11 * random.unit(), 30 + 11 * random.unit()};
      if (is_near_a_side(sides, p)) continue;
      const std::size_t expected = expected_region(sides, p);
      std::vector<std::size_t> has;
      for (std::size_t i = 0; i < regions.size(); ++i) {
        if (has_inside(regions[i], p)) has.push_back(i);
      }
      EXPECT_LE(has.size(), 1U);
      EXPECT_TRUE(has.empty() == (expected == sides.size()) || has_lost) << round;
      if (!has_lost && !has.empty()) {
        EXPECT_EQ(has[0], expected) << round;
      }
    }
  }
}

TEST(settled_regions, have_equal_borders) {
  // Two squares and, between them, a sliver whose lines have passed each other.
  const Sides sides = {sides_of_loop({{0, 0}, {4, 0}, {4.001, 4}, {0, 4}}),
                       sides_of_loop({{4, 0}, {4.001, 4}, {3.999, 4}}),
                       sides_of_loop({{4, 0}, {8, 0}, {8, 4}, {3.999, 4}})};
  std::vector<PlanarRegion> regions = settled(sides);
  for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "");
  ASSERT_EQ(regions[1].size(), 1U);  // though the first square goes around all of it
  const Sides turned = {sides_of_loop({{0, 0}, {4, 0}, {4.001, 4}, {0, 4}}),
                        sides_of_loop({{4, 0}, {3.999, 4}, {4.001, 4}}),
                        sides_of_loop({{4, 0}, {8, 0}, {8, 4}, {3.999, 4}})};
  regions = settled(turned);
  for (const PlanarRegion& region : regions) EXPECT_EQ(why_invalid(region), "");
  ASSERT_EQ(regions[1].size(), 1U);
  EXPECT_EQ(regions[1][0][0].size(), 4U);
  EXPECT_TRUE(has_inside(regions[1], {4, 3.9}));
  EXPECT_FALSE(has_inside(regions[0], {4, 3.9}));
}

TEST(settled_regions, of_nothing_are_nothing) {
  EXPECT_TRUE(map::settled_regions({}, 1).empty());
  EXPECT_EQ(map::settled_regions(Sides(2), 1).size(), 2U);
  const Sides spike = {sides_of_loop({{0, 0}, {4, 0}})};
  EXPECT_TRUE(map::settled_regions(spike, 1)[0].empty());
}

}  // namespace
}  // namespace rondel::test
