// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The base case of divide and conquer: the table of four points, which the compiler fills, is
// computed again at run time for all signs that four points in the plane can have.
#include "bulk/few_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace rondel::test {
namespace {

struct Place {
  int x;
  int y;
};

int doubled_area(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

using Places = std::array<Place, 4>;

// A bit for each of abc, abd, acd, bcd.
unsigned signs_of(const Places& p) {
  const std::array<std::array<std::size_t, 3>, 4> triples = {
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  unsigned signs = 0;
  for (std::size_t i = 0; i < triples.size(); ++i) {
    const auto& [a, b, c] = triples[i];
    if (doubled_area(p[a], p[b], p[c]) > 0) signs |= 1U << i;
  }
  return signs;
}

bool has_three_in_line(const Places& p) {
  return doubled_area(p[0], p[1], p[2]) == 0 || doubled_area(p[0], p[1], p[3]) == 0 ||
         doubled_area(p[0], p[2], p[3]) == 0 || doubled_area(p[1], p[2], p[3]) == 0;
}

// What the picture of few_sites.h says.
void expect_order(const Places& p, const bulk::FourSites& found) {
  std::array<std::uint8_t, 4> sorted = found.order;
  std::ranges::sort(sorted);
  ASSERT_EQ(sorted, (std::array<std::uint8_t, 4>{0, 1, 2, 3}));
  const auto at = [&](std::size_t i) { return p[found.order[i]]; };
  const auto is_left = [&](std::size_t i, std::size_t j, std::size_t k) {
    return doubled_area(at(i), at(j), at(k)) > 0;
  };
  EXPECT_TRUE(is_left(0, 1, 2));
  if (found.has_inner_point) {
    EXPECT_TRUE(is_left(0, 1, 3) && is_left(1, 2, 3) && is_left(2, 0, 3));
  } else {
    EXPECT_TRUE(is_left(1, 2, 3) && is_left(2, 3, 0) && is_left(3, 0, 1));
  }
}

TEST(few_sites, order_of_any_four_points) {
  constexpr int width = 4;
  std::array<bool, 16> was_seen{};
  const auto place = [](unsigned code) {
    return Place{static_cast<int>(code % width), static_cast<int>(code / width % width)};
  };
  for (unsigned code = 0; code < 1U << 16; ++code) {
    const Places p = {place(code), place(code >> 4), place(code >> 8), place(code >> 12)};
    if (has_three_in_line(p)) continue;
    const unsigned signs = signs_of(p);
    const bulk::FourSites found = bulk::few_sites::find_order(signs);
    expect_order(p, found);
    EXPECT_EQ(found.order, bulk::few_sites::orders[signs].order);
    EXPECT_EQ(found.has_inner_point, bulk::few_sites::orders[signs].has_inner_point);
    was_seen[signs] = true;
    ASSERT_FALSE(HasFailure()) << code;
  }
  EXPECT_EQ(std::ranges::count(was_seen, true), 14);  // the other two are impossible
}

TEST(few_sites, table_made_again) {
  const auto made = bulk::few_sites::make_orders();
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(made[i].order, bulk::few_sites::orders[i].order);
  }
}

}  // namespace
}  // namespace rondel::test
