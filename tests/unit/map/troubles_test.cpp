// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// look_at_region(): the polygons of a region, or what keeps its loops from being polygons.
//
//     touching          crossing          unpaired, beside          turned
//      +---+             +   +                /|                    +-->--+
//      |    \            |\ /|               //|   two corners      |     |   clockwise
//      |     +           | X |              // |   in one place     |     |
//      +--+--+--+        |/ \|             +---+                    +--<--+
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "map/line_troubles.h"
#include "support/random.h"

namespace rondel::test::of_troubles {
namespace {

using map::Loop;
using map::SharedLines;
using map::Trouble;
using Kind = map::Trouble::TroubleKind;

map::RegionLook look_at(const std::vector<Loop>& loops, const SharedLines& shared = {}) {
  map::RegionMemory memory;
  return map::look_at_region(loops, shared, memory);
}

TEST(region_troubles, a_plain_region_has_none) {
  const Loop square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const map::RegionLook look = look_at({square});
  EXPECT_TRUE(look.troubles.empty());
  ASSERT_EQ(look.polygons.size(), 1U);
  EXPECT_EQ(look.polygons[0].rings, (std::vector<Loop>{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}}));
  EXPECT_FALSE(map::is_in_trouble({square}));
  EXPECT_FALSE(map::is_in_trouble({}));
  EXPECT_TRUE(map::is_in_trouble({{{0, 0}, {0, 4}, {4, 4}, {4, 0}}}));
}

// Sides that lead there and back are no sides; the rest of the loop is traced.
TEST(region_troubles, sides_there_and_back_are_removed) {
  const map::RegionLook look = look_at({{{0, 0}, {4, 0}, {4, 4}, {6, 8}, {4, 4}, {0, 4}}});
  EXPECT_TRUE(look.troubles.empty());
  ASSERT_EQ(look.polygons.size(), 1U);
  EXPECT_EQ(look.polygons[0].rings, (std::vector<Loop>{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}}));
  const map::RegionLook nothing = look_at({{{0, 0}, {4, 0}}});
  EXPECT_TRUE(nothing.troubles.empty());
  EXPECT_TRUE(nothing.polygons.empty());
}

TEST(region_troubles, sides_that_cross) {
  const map::RegionLook look = look_at({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}});
  EXPECT_TRUE(look.polygons.empty());
  ASSERT_EQ(look.troubles.size(), 1U);
  const Trouble& trouble = look.troubles[0];
  EXPECT_EQ(trouble.kind, Kind::crossing);
  EXPECT_EQ(trouble.a, (LonLat{0, 0}));
  EXPECT_EQ(trouble.b, (LonLat{4, 4}));
  EXPECT_EQ(trouble.c, (LonLat{4, 0}));
  EXPECT_EQ(trouble.d, (LonLat{0, 4}));
}

// The corner (2, 0) is on the side from (0, 0) to (4, 0), and two sides have it as an end.
TEST(region_troubles, a_corner_that_touches_a_side) {
  const map::RegionLook look = look_at({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}});
  ASSERT_EQ(look.troubles.size(), 2U);
  for (const Trouble& trouble : look.troubles) {
    EXPECT_EQ(trouble.kind, Kind::touching);
    EXPECT_EQ(trouble.a, (LonLat{0, 0}));
    EXPECT_EQ(trouble.b, (LonLat{4, 0}));
    EXPECT_EQ(trouble.c, (LonLat{2, 0}));
  }
}

// A triangle in the corner of another one.
TEST(region_troubles, sides_that_do_not_alternate_around_a_corner) {
  const map::RegionLook look = look_at({{{0, 0}, {4, 1}, {1, 4}}, {{0, 0}, {2, 1}, {1, 2}}});
  ASSERT_EQ(look.troubles.size(), 4U);
  const std::array<LonLat, 5> around{{{4, 1}, {2, 1}, {1, 2}, {1, 4}, {4, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Trouble& trouble = look.troubles[i];
    EXPECT_EQ(trouble.kind, i % 2 == 0 ? Kind::unpaired : Kind::beside);
    EXPECT_EQ(trouble.a, (LonLat{0, 0}));
    EXPECT_EQ(trouble.b, around[i]);
    EXPECT_EQ(trouble.c, (LonLat{0, 0}));
    EXPECT_EQ(trouble.d, around[i + 1]);
  }
}

// The clockwise loop is the trouble; the polygons of other loops are given all the same.
TEST(region_troubles, a_loop_that_is_turned_over) {
  const Loop turned = {{6, 0}, {6, 4}, {8, 4}};
  const map::RegionLook look = look_at({{{0, 0}, {4, 0}, {4, 4}}, turned});
  EXPECT_EQ(look.polygons.size(), 1U);
  ASSERT_EQ(look.troubles.size(), 1U);
  EXPECT_EQ(look.troubles[0].kind, Kind::turned);
  EXPECT_EQ(look.troubles[0].loop, turned);
  EXPECT_EQ(look.troubles[0].a, turned[0]);
}

// A line that is divided is drawn with its parts: its middle goes around the corner that touched it.
TEST(region_troubles, are_those_of_the_divided_lines) {
  const std::vector<Loop> loops = {{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}};
  SharedLines shared;
  shared.divide({0, 0}, {4, 0}, {2, -1});
  const map::RegionLook look = look_at(loops, shared);
  EXPECT_TRUE(look.troubles.empty());
  ASSERT_EQ(look.polygons.size(), 1U);
  EXPECT_EQ(look.polygons[0].rings[0].size(), 7U);
}

auto key_of(const Trouble& t) {
  // Each of two lines may be named first, and so may each end of a line be.
  std::array<double, 4> x = {t.a.lon_deg, t.a.lat_deg, t.b.lon_deg, t.b.lat_deg};
  std::array<double, 4> y = {t.c.lon_deg, t.c.lat_deg, t.d.lon_deg, t.d.lat_deg};
  if (t.kind == Kind::crossing && y < x) std::swap(x, y);
  return std::tuple(t.kind, x, y);
}

auto keys_of(const std::vector<Trouble>& troubles) {
  std::vector<decltype(key_of(Trouble{}))> keys;
  for (const Trouble& trouble : troubles) keys.push_back(key_of(trouble));
  std::ranges::sort(keys);
  // A corner touches a side once for each side that ends there, and some of these may be gone.
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

// A look with the memory of the look before finds what a look without it finds, however lines have been divided between.
TEST(region_troubles, are_the_same_with_and_without_memory) {
  Random random(82);
  const auto position = [&] {
    return LonLat{static_cast<double>(random.below(9)), static_cast<double>(random.below(9))};
  };
  std::size_t num_troubles = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Loop> loops(1 + random.below(3));
    for (Loop& loop : loops) {
      for (std::size_t k = 3 + random.below(5); k-- > 0;) loop.push_back(position());
      loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    }
    SharedLines shared;
    map::RegionMemory memory;
    for (int look = 0; look < 6; ++look) {
      const map::RegionLook with = map::look_at_region(loops, shared, memory);
      const map::RegionLook without = look_at(loops, shared);
      EXPECT_EQ(keys_of(with.troubles), keys_of(without.troubles)) << round << ' ' << look;
      EXPECT_EQ(with.polygons.size(), without.polygons.size());
      num_troubles += with.troubles.size();
      const Loop& loop = loops[random.below(loops.size())];
      const std::size_t k = random.below(loop.size());
      shared.divide(loop[k], loop[(k + 1) % loop.size()], position());
    }
  }
  EXPECT_GT(num_troubles, 1000U);
}

}  // namespace
}  // namespace rondel::test::of_troubles
