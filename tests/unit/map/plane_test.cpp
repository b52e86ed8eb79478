// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Predicates of the plane, on all positions of a small grid, against whole numbers and angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "map/map_plane.h"
#include "map/rectangles.h"
#include "support/random.h"

namespace rondel::test::of_plane {
namespace {

// Positions (-1, -1) to (2, 2) and one beside the grid.
std::vector<LonLat> grid_positions() {
  std::vector<LonLat> positions = {{3, 1}};
  for (int x = -1; x <= 2; ++x) {
    for (int y = -1; y <= 2; ++y)
      positions.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  return positions;
}

double grid_product(const LonLat& o, const LonLat& p, const LonLat& o2, const LonLat& q) {
  return (p.lon_deg - o.lon_deg) * (q.lat_deg - o2.lat_deg) -
         (p.lat_deg - o.lat_deg) * (q.lon_deg - o2.lon_deg);
}

Sign sign_of(double number) {
  return number > 0 ? Sign::positive : (number < 0 ? Sign::negative : Sign::zero);
}

// The angle from the east, counterclockwise, from 0 to less than 2 pi.
double grid_angle(const LonLat& at, const LonLat& p) {
  const double angle = std::atan2(p.lat_deg - at.lat_deg, p.lon_deg - at.lon_deg);
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

TEST(map_plane, sides_and_places_on_a_grid) {
  const std::vector<LonLat> all = grid_positions();
  for (const LonLat& p : all) {
    for (const LonLat& q : all) {
      for (const LonLat& r : all) {
        EXPECT_EQ(map::side_of_line(p, q, r), sign_of(grid_product(p, q, p, r)));
        // Between: the distances add up.
        const auto away = [](const LonLat& a, const LonLat& b) {
          return std::hypot(a.lon_deg - b.lon_deg, a.lat_deg - b.lat_deg);
        };
        const bool is_between =
            !(r == p) && !(r == q) && std::abs(away(p, r) + away(r, q) - away(p, q)) < 1e-9;
        EXPECT_EQ(map::is_between(p, q, r), is_between);
        if (p == q || p == r) continue;
        EXPECT_EQ(map::is_before_around(p, q, r), grid_angle(p, q) < grid_angle(p, r) - 1e-9);
      }
    }
  }
}

// Two lines cross if the shares of both at which they meet are between 0 and 1.
TEST(map_plane, crossings_on_a_grid) {
  const std::vector<LonLat> all = grid_positions();
  for (const LonLat& a : all) {
    for (const LonLat& b : all) {
      for (const LonLat& c : all) {
        for (const LonLat& d : all) {
          const double whole = grid_product(a, b, c, d);
          const double of_ab = grid_product(a, c, c, d) / whole;
          const double of_cd = grid_product(a, c, a, b) / whole;
          const bool cross =
              whole != 0 && of_ab > 1e-9 && of_ab < 1 - 1e-9 && of_cd > 1e-9 && of_cd < 1 - 1e-9;
          ASSERT_EQ(map::do_lines_cross(a, b, c, d), cross);
        }
      }
    }
  }
}

// The line leads along the diagonal, so that the coordinates themselves tell the side.
TEST(map_plane, sides_are_exact) {
  constexpr double step = 0x1p-53;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 24; ++j) {
      const LonLat r{0.5 + i * step, 0.5 + j * step};
      EXPECT_EQ(map::side_of_line({12, 12}, {24, 24}, r), sign_of(j - i));
      EXPECT_EQ(map::side_of_line({24, 24}, {12, 12}, r), sign_of(i - j));
    }
  }
}

TEST(map_plane, orders_by_longitude_first) {
  const map::InPlane less;
  EXPECT_TRUE(less({1, 9}, {2, 0}));
  EXPECT_FALSE(less({2, 0}, {1, 9}));
  EXPECT_TRUE(less({1, 3}, {1, 4}));
  EXPECT_FALSE(less({1, 4}, {1, 3}));
  EXPECT_FALSE(less({1, 4}, {1, 4}));
  EXPECT_EQ(map::distance_in_plane({1, 9}, {3, 4}), 7);
}

TEST(map_plane, rectangles_are_closed) {
  const LonLat a{4, -1};
  const LonLat b{2, 3};
  for (const LonLat& p : {LonLat{2, -1}, {4, 3}, {3, 0}, {4, 0}, {3, 3}}) {
    EXPECT_TRUE(map::is_beside(a, b, p));
    EXPECT_TRUE(map::is_beside(b, a, p));
  }
  for (const LonLat& p : {LonLat{1.5, 0}, {4.5, 0}, {3, -1.5}, {3, 3.5}})
    EXPECT_FALSE(map::is_beside(a, b, p));
}

// An arrowhead, whose corners are begun with one after the other.
TEST(map_plane, loops_turn_one_way) {
  std::vector<LonLat> loop = {{0, 0}, {4, -3}, {1, 0}, {4, 3}};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    EXPECT_TRUE(map::is_counterclockwise(loop));
    std::ranges::reverse(loop);
    EXPECT_FALSE(map::is_counterclockwise(loop));
    std::ranges::reverse(loop);
  }
}

TEST(map_plane, spikes_on_a_grid) {
  const std::vector<LonLat> all = grid_positions();
  for (const LonLat& p : all) {
    for (const LonLat& q : all) {
      // The corner (0, 0) is a tip if p and q are in the same direction from it.
      const LonLat tip{0, 0};
      if (p == tip || q == tip) continue;
      const bool is_spike = std::abs(grid_angle(tip, p) - grid_angle(tip, q)) < 1e-9;
      // The other corners are far away and turn.
      const std::vector<LonLat> loop = {tip, q, {61, 47}, {37, 83}, p};
      EXPECT_EQ(map::has_spike(loop), is_spike)
          << p.lon_deg << ' ' << p.lat_deg << ", " << q.lon_deg << ' ' << q.lat_deg;
    }
  }
}

struct NamePair {
  std::size_t first;
  std::size_t second;
  friend auto operator<=>(const NamePair&, const NamePair&) = default;
};

bool have_overlap(const map::Line& a, const map::Line& b) {
  const auto meets = [](double p, double q, double r, double s) {
    return std::max(std::min(p, q), std::min(r, s)) <= std::min(std::max(p, q), std::max(r, s));
  };
  return meets(a.from.lon_deg, a.to.lon_deg, b.from.lon_deg, b.to.lon_deg) &&
         meets(a.from.lat_deg, a.to.lat_deg, b.from.lat_deg, b.to.lat_deg);
}

// The pairs of overlapping lines i in [begin, begin + size) and j in [other, other + size), quarter
// by quarter.
void append_between(const std::vector<map::Line>& lines, std::size_t begin, std::size_t other,
                    std::size_t size, std::vector<NamePair>& pairs) {
  if (other >= lines.size()) return;
  if (size == 1) {
    if (have_overlap(lines[begin], lines[other])) pairs.push_back({begin, other});
    return;
  }
  const std::size_t half = size / 2;
  for (const std::size_t i : {begin, begin + half}) {
    for (const std::size_t j : {other, other + half}) append_between(lines, i, j, half, pairs);
  }
}

// Those of [begin, begin + size): of each half, then of both.
void append_within(const std::vector<map::Line>& lines, std::size_t begin, std::size_t size,
                   std::vector<NamePair>& pairs) {
  if (size == 1) return;
  const std::size_t half = size / 2;
  append_within(lines, begin, half, pairs);
  append_within(lines, begin + half, half, pairs);
  append_between(lines, begin, begin + half, half, pairs);
}

// Few lines, many in a run, and many anywhere, which the tree has in an order of its own.
TEST(rectangles, are_found_in_an_order_that_the_lines_alone_decide) {
  Random random(72);
  for (const std::size_t n : {30U, 63U, 64U, 65U, 127U, 256U, 300U}) {
    for (const bool is_run : {false, true}) {
      std::vector<map::Line> lines;
      const auto coordinate = [&] { return static_cast<double>(random.below(1000)); };
      LonLat from{coordinate(), coordinate()};
      for (std::size_t i = 0; i < n; ++i) {
        const LonLat to{from.lon_deg + static_cast<double>(random.below(100)),
                        from.lat_deg + static_cast<double>(random.below(100))};
        lines.push_back({from, to, i});
        from = is_run ? to : LonLat{coordinate(), coordinate()};
      }
      EXPECT_EQ(map::order_along_curve(lines).empty(), is_run || n < 64);
      std::vector<NamePair> found;
      const map::Rectangles tree(lines);
      tree.find_overlapping([&](const map::Line& a, const map::Line& b) {
        found.push_back({a.name, b.name});
      });
      std::vector<NamePair> expected;
      append_within(lines, 0, 512, expected);
      EXPECT_EQ(found, expected) << n;
      std::vector<std::size_t> inside;
      tree.find_overlapping({200, 500, 300, 700},
                            [&](const map::Line& line) { inside.push_back(line.name); });
      std::vector<std::size_t> expected_inside;
      for (std::size_t i = 0; i < n; ++i) {
        if (have_overlap(lines[i], {{200, 300}, {500, 700}, 0})) expected_inside.push_back(i);
      }
      EXPECT_EQ(inside, expected_inside) << n;
    }
  }
}

// Each pair once, the earlier line first; whole numbers make rectangles touch.
TEST(rectangles, find_what_all_pairs_say) {
  Random random(71);
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<map::Line> lines;
    const auto coordinate = [&] { return static_cast<double>(random.below(12)); };
    for (std::size_t i = 0; i < n; ++i) {
      const LonLat from{coordinate(), coordinate()};
      const LonLat to{from.lon_deg + static_cast<double>(random.below(3)) - 1,
                      from.lat_deg + static_cast<double>(random.below(3)) - 1};
      lines.push_back({from, to, 100 + i});
    }
    const map::Rectangles tree(lines);
    std::vector<NamePair> found;
    tree.find_overlapping([&](const map::Line& a, const map::Line& b) {
      found.push_back({a.name - 100, b.name - 100});
    });
    std::vector<NamePair> expected;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        if (have_overlap(lines[i], lines[j])) expected.push_back({i, j});
      }
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << n;
    for (double x = -1; x < 12; x += 3) {
      const map::Line box{{x, 3}, {x + 2, 7}, 0};
      std::vector<std::size_t> inside;
      tree.find_overlapping({x, x + 2, 3, 7},
                            [&](const map::Line& line) { inside.push_back(line.name - 100); });
      std::vector<std::size_t> expected_inside;
      for (std::size_t i = 0; i < n; ++i) {
        if (have_overlap(lines[i], box)) expected_inside.push_back(i);
      }
      EXPECT_EQ(inside, expected_inside) << n;
    }
  }
}

}  // namespace
}  // namespace rondel::test::of_plane
