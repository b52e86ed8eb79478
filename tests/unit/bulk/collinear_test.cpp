// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The library finds which of three sites on one great circle is between the others: m = i a + j b
// is between a and b if i and j are positive, and in the triangle with the center if also i + j <=
// 1. All numbers are integers, so nothing is rounded.
#include "bulk/collinear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bulk/few_sites.h"
#include "exact/vector.h"
#include "gtest/gtest.h"
#include "support/divided_faces.h"
#include "support/random.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

using bulk::Between;

Between expected(int i, int j, int denominator) {
  if (i <= 0 || j <= 0) return Between::no;
  return i + j <= denominator ? Between::below : Between::yes;
}

Point random_point(Random& random, int most) {
  return {1.0 * random.between(-most, most), 1.0 * random.between(-most, most),
          1.0 * random.between(-most, most)};
}

bool are_parallel(const Point& a, const Point& b) {
  return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
}

void expect_between(Random& random, int most, int nearness, const Point& center, double scale) {
  Point a = random_point(random, most);
  Point b = random_point(random, most);
  if (nearness > 1) b = nearness * a + b;
  if (are_parallel(a, b)) return;
  constexpr int denominator = 8;
  const int i = random.between(-12, 12);
  const int j = random.between(-12, 12);
  if (i <= 0 && j <= 0) return;  // in no half plane, or the center
  const Point m = i * a + j * b;
  const auto place = [&](const Point& p) { return center + scale * p; };
  const Between between =
      bulk::is_between(place(denominator * a), place(m), place(denominator * b), place({}));
  EXPECT_EQ(between, expected(i, j, denominator)) << i << ' ' << j;
}

TEST(bulk_collinear, middle_of_three_sites) {
  Random random(71);
  for (int k = 0; k < 20000; ++k) {
    expect_between(random, 3, 1, {}, 1);
    expect_between(random, 1000, 1, {}, 1);
    expect_between(random, 1000, 1, {1e6, -3e5, 7e5}, 1);
    expect_between(random, 1 << 20, 1 << 20, {}, 1);  // close together
    expect_between(random, 1000, 1 << 20, {}, 1);
  }
}

// Where lengths or products of doubles overflow or lose bits.
TEST(bulk_collinear, middle_of_three_sites_at_any_scale) {
  Random random(72);
  for (int k = 0; k < 300; ++k) {
    for (const int exponent : {-1060, -600, -540, -300, -270, 250, 300, 500, 990}) {
      expect_between(random, 100, 1, {}, std::ldexp(1.0, exponent));
    }
  }
}

// Near each other, and with differences from the center that no double holds: in a plane x = const,
// with integers in units of 2^-60.
TEST(bulk_collinear, middle_of_three_sites_that_doubles_cannot_tell_apart) {
  using Integer = __int128;
  struct Ray {
    std::int64_t y, z;
  };
  const auto turn = [](const Ray& a, const Ray& b) {
    const Integer value = Integer{a.y} * b.z - Integer{a.z} * b.y;
    return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
  };
  const auto minus = [](const Ray& a, const Ray& b) { return Ray{a.y - b.y, a.z - b.z}; };
  Random random(73);
  int num_between = 0;
  for (int k = 0; k < 20000; ++k) {
    const Ray center = {random.between(-1000000, 1000000), random.between(-1000000, 1000000)};
    const std::int64_t ulp = std::int64_t{1} << 8;
    const Ray first = {(std::int64_t{1} << 60) + ulp * random.between(0, 1 << 20),
                       (std::int64_t{1} << 60) + ulp * random.between(0, 1 << 20)};
    std::array<Ray, 3> rays{};
    std::array<Point, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const Ray p = {first.y + ulp * random.between(-4, 4), first.z + ulp * random.between(-4, 4)};
      rays[i] = minus(p, center);
      points[i] = {1, std::ldexp(static_cast<double>(p.y), -60),
                   std::ldexp(static_cast<double>(p.z), -60)};
    }
    const auto& [a, m, b] = rays;
    const int all = turn(a, b);
    if (all == 0) continue;
    Between between = Between::no;
    if (turn(a, m) * all > 0 && turn(m, b) * all > 0) {
      between = turn(minus(m, a), minus(b, a)) * all > 0 ? Between::yes : Between::below;
      ++num_between;
    }
    const Point c = {1, std::ldexp(static_cast<double>(center.y), -60),
                     std::ldexp(static_cast<double>(center.z), -60)};
    EXPECT_EQ(bulk::is_between(points[0], points[1], points[2], c), between);
  }
  EXPECT_GT(num_between, 1000);
}

// Divide and conquer by itself, and whole builds, on thousands of small sets in which everything is
// degenerate: integers of one digit, so that most sites are cocircular, on one line or hidden.

// Small integers on one face of the cube.
SiteSet small_integers_on_a_face(Random& random) {
  SiteSet set;
  const int n = random.between(2, 40);
  const int depth = random.between(0, 3);
  const int width = random.between(1, 6);
  const int pole = random.coin() ? 8 : 7;
  for (int i = 0; i < n; ++i) {
    const int z = pole + random.between(0, depth);
    set.sites.push_back({static_cast<double>(random.between(-width, width)),
                         static_cast<double>(random.between(-width, width)),
                         static_cast<double>(random.coin() ? pole : z)});
  }
  return set;
}

struct Count {
  std::size_t solved = 0;
  std::size_t left = 0;
};

template <class T>
void compare(const SiteSet& set, Count& count) {
  const Divided result = divide_and_compare<T>(set, {6.9, 16});
  EXPECT_NE(result, Divided::different);
  if (result == Divided::same) ++count.solved;
  if (result == Divided::left_to_seam) ++count.left;
}

TEST(bulk_divide, finds_the_faces_that_the_center_sees) {
  Random random(21);
  Count projected;
  Count weighted;
  for (std::size_t i = 0; i < scaled(5000); ++i) {
    const SiteSet set = small_integers_on_a_face(random);
    SCOPED_TRACE(i);
    compare<models::ProjectedPoints>(set, projected);
    compare<models::WeightedPoints>(set, weighted);
    ASSERT_FALSE(HasFailure());
  }
  // Only weighted sites that are hidden on a line with others are left to the seam.
  EXPECT_EQ(projected.left, 0U);
  EXPECT_GT(weighted.solved, weighted.left / 4);
  RecordProperty("weighted_left", std::to_string(weighted.left));
}

// General positions, most sites hidden.
TEST(bulk_divide, sites_that_hide_each_other) {
  Random random(22);
  Count count;
  for (std::size_t i = 0; i < scaled(3000); ++i) {
    SiteSet set;
    const int n = random.between(4, 60);
    const double depth = random.unit();
    for (int k = 0; k < n; ++k) {
      const Point p = {random.signed_unit(), random.signed_unit(), 1};
      set.sites.push_back((7 + depth * random.unit()) * p);
    }
    SCOPED_TRACE(i);
    compare<models::WeightedPoints>(set, count);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_EQ(count.left, 0U);
}

TEST(bulk_divide, whole_builds_of_small_integers) {
  Random random(23);
  for (std::size_t i = 0; i < scaled(1500); ++i) {
    SiteSet set;
    const int size = random.between(2, 5);
    const int n = random.between(40, 200);
    const Point shift = {0, 0, static_cast<double>(random.coin() ? size + 2 : 0)};
    for (int k = 0; k < n; ++k) {
      const Point p = Point{static_cast<double>(random.between(-size, size)),
                            static_cast<double>(random.between(-size, size)),
                            static_cast<double>(random.between(-size, size))} +
                      shift;
      if (p != Point{}) set.sites.push_back(p);
    }
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(text_of(model) + " " + std::to_string(i));
      BulkCase sites(set, model);
      const bool is_flat = sites.expected().dimension < 2;
      EXPECT_NE(sites.run(static_cast<std::size_t>(random.between(33, 100))), is_flat);
      EXPECT_NE(sites.run(1000), is_flat);
    }
    ASSERT_FALSE(HasFailure());
  }
}

// The base case of divide and conquer: the table of four points, which the compiler fills, is
// computed again at run time for all signs that four points in the plane can have.

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
