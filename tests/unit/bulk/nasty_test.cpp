// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites where cells end: on their lines, in their corners, on both sides within one ulp.
#include <array>
#include <cmath>

#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

// A place (u, v) on one of the six faces of the cube.
Point on_cube(unsigned face, double u, double v) {
  const double side = face % 2 == 0 ? 1 : -1;
  if (face / 2 == 0) return {side, u, v};
  return face / 2 == 1 ? Point{v, side, u} : Point{u, v, side};
}

// Multiples of 2^-bits: on the lines of the cells.
double on_line(Random& random, int bits) {
  const int count = 1 << bits;
  return std::ldexp(random.between(-count, count), -bits);
}

SiteSet grid_of_lines(int bits, unsigned num_faces) {
  SiteSet set;
  const int count = 1 << bits;
  for (unsigned face = 0; face < num_faces; ++face) {
    for (int i = -count; i <= count; ++i) {
      for (int j = -count; j <= count; ++j) {
        set.sites.push_back(on_cube(face, std::ldexp(i, -bits), std::ldexp(j, -bits)));
      }
    }
  }
  return set;
}

// Sites of a coarse grid, moved by up to some ulps, of lengths 1 ... 2^range.
SiteSet near_lines(Random& random, std::size_t n, int bits, int ulps, int range) {
  SiteSet set;
  while (set.sites.size() < n) {
    Point p = on_cube(static_cast<unsigned>(random.below(6)), on_line(random, bits),
                      on_line(random, bits));
    for (int k = random.between(0, ulps); k > 0; --k) p = moved_by_one_ulp(random, p);
    set.sites.push_back(std::ldexp(1.0, random.between(0, range)) * p);
  }
  return set;
}

// Both models, small and large blocks.
void expect_same(const SiteSet& set, std::initializer_list<std::size_t> block_sizes) {
  for (const Model model : {Model::projected, Model::weighted}) {
    SCOPED_TRACE(text_of(model));
    BulkCase sites(set, model);
    for (const std::size_t size : block_sizes) {
      SCOPED_TRACE(size);
      const bool has_run = size % 3 == 0 ? sites.run_with_copies(size, 3) : sites.run(size);
      EXPECT_TRUE(has_run || sites.expected().dimension < 2);
    }
  }
}

TEST(bulk_nasty, grids_on_the_lines_of_cells) {
  for (const int bits : {2, 3, 4}) {
    expect_same(grid_of_lines(bits, 6), {40, 100, 1000, 32768});
    expect_same(grid_of_lines(bits, 1), {40, 100, 1000});
  }
}

TEST(bulk_nasty, sites_within_ulps_of_the_lines) {
  Random random(11);
  for (std::size_t i = 0; i < scaled(40); ++i) {
    const int bits = random.between(1, 6);
    SCOPED_TRACE(i);
    expect_same(near_lines(random, 600, bits, random.between(0, 3), 0), {40, 150, 1000});
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(bulk_nasty, sites_near_lines_in_all_directions_of_rounding) {
  Random random(12);
  for (std::size_t i = 0; i < scaled(20); ++i) {
    SiteSet set = near_lines(random, 600, random.between(1, 4), 1, 0);
    const std::array<Point, 5> centers = {
        {{0.1, 0.2, -0.3}, {1e6, 1, -0.1}, {0x1p-30, 0, 0}, {1e-20, 1, 2}, {0.5, 0.25, 8}}};
    set.sphere.center = centers[i % centers.size()];
    for (Point& p : set.sites) p = p + set.sphere.center;
    SCOPED_TRACE(i);
    expect_same(set, {40, 150, 1000});
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

// With a center the order knows exact positions, and differences rounded to doubles may lie beyond
// the line at which a block ends. Few sites on lines, so that most blocks have none on others.
TEST(bulk_nasty, sites_on_the_lines_where_blocks_end) {
  Random random(1);
  const std::array<Point, 6> centers = {{{0.1, 0.2, -0.3},
                                         {1e6, 1, -0.1},
                                         {0x1p-30, 0, 0},
                                         {1e-20, 1, 2},
                                         {0.5, 0.25, 8},
                                         {1e3, 3, 7}}};
  for (std::size_t i = 0; i < scaled(100); ++i) {
    SiteSet set;
    set.sphere.center = centers[i % centers.size()];
    for (int k = 0; k < 1500; ++k) {
      set.sites.push_back(set.sphere.center + random_direction(random));
    }
    for (int k = random.between(1, 60); k > 0; --k) {
      const double u = on_line(random, 1 + static_cast<int>(i % 3));
      const double v = random.signed_unit();
      const auto face = static_cast<unsigned>(random.below(6));
      const Point p =
          set.sphere.center + normalized(random.coin() ? on_cube(face, u, v) : on_cube(face, v, u));
      set.sites.push_back(random.coin() ? moved_by_one_ulp(random, p) : p);
    }
    SCOPED_TRACE(i);
    expect_same(set, {40, 100, 300});
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(bulk_nasty, great_circles_through_corners_of_cells) {
  Random random(13);
  for (std::size_t i = 0; i < scaled(20); ++i) {
    SiteSet set;
    const Point pole = {static_cast<double>(random.between(-4, 4)),
                        static_cast<double>(random.between(-4, 4)),
                        static_cast<double>(random.between(1, 4))};
    for (int k = 0; k < 400; ++k) {
      // Small integers: exactly on the circle.
      const Point p =
          static_cast<double>(random.between(-40, 40)) * cross_product(pole, {1, 2, 3}) +
          static_cast<double>(random.between(-40, 40)) * cross_product(pole, {3, -1, 2});
      if (p != Point{}) set.sites.push_back(p);
    }
    for (int k = 0; k < 200; ++k) set.sites.push_back(8.0 * random_direction(random));
    SCOPED_TRACE(i);
    expect_same(set, {40, 100, 1000});
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(bulk_nasty, clusters_of_any_density) {
  Random random(14);
  for (const double radius : {1e-3, 1e-6, 1e-7, 1e-9, 1e-12, 1e-14, 1e-15, 1e-16}) {
    SiteSet set;
    const Point corner = normalized({1, 0.5, 0.25});
    for (int k = 0; k < 700; ++k) set.sites.push_back(random_near(random, corner, radius));
    for (int k = 0; k < 300; ++k) set.sites.push_back(random_direction(random));
    SCOPED_TRACE(radius);
    expect_same(set, {40, 100, 1000});
  }
}

// No square is so small that it has no more sites than a trial wants.
TEST(bulk_nasty, trial_of_a_crowd_at_one_position) {
  Random random(18);
  SiteSet set;
  while (set.sites.size() < 40'000) {
    const double size = std::ldexp(1.0, random.between(-900, -100));
    set.sites.push_back({size * random.signed_unit(), size * random.signed_unit(), 1});
  }
  for (const Model model : {Model::projected, Model::weighted}) {
    system::Job options;
    options.model = model;
    const auto order = order::spatial_order(set.sites, model, {}, 1);
    EXPECT_FALSE(bulk::has_short_seams(bulk::make_input(set.sites, order.order, options, {})));
  }
}

TEST(bulk_nasty, one_block_and_one_cell) {
  Random random(15);
  for (const double radius : {0.3, 1e-3, 1e-6, 1e-10}) {
    SiteSet set;
    for (int k = 0; k < 500; ++k) {
      set.sites.push_back(random_near(random, normalized({0.3, 1, 0.1}), radius));
    }
    expect_same(set, {40, 100, 1000, 32768});
    for (Point& p : set.sites) p = (1 + random.unit()) * p;
    expect_same(set, {40, 100, 1000, 32768});
  }
}

TEST(bulk_nasty, weights_that_hide_most) {
  Random random(16);
  for (const double range : {1e-12, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 100.0}) {
    for (const Point& center : {Point{}, Point{0.1, 0.2, 0.3}, Point{3, 0, 0}}) {
      SiteSet set;
      set.sphere.center = center;
      for (int k = 0; k < 1000; ++k) {
        set.sites.push_back((1 + range * random.unit()) * random_direction(random));
      }
      SCOPED_TRACE(range);
      expect_same(set, {40, 100, 1000, 32768});
    }
  }
}

// The last ones: at the center itself, and on one ray.
TEST(bulk_nasty, weighted_sites_at_the_center_and_on_one_ray) {
  Random random(17);
  for (const Point& center : {Point{}, Point{0.1, 0.2, 0.3}}) {
    SiteSet set;
    set.sphere.center = center;
    set.sites.push_back(center);
    for (int k = 0; k < 600; ++k) {
      const Point p = random_direction(random);
      set.sites.push_back(center + p);
      if (k % 3 == 0) set.sites.push_back(center + random.unit() * p);
      if (k % 5 == 0) set.sites.push_back(center + 1.25 * p);
    }
    BulkCase sites(set, Model::weighted);
    for (const std::size_t size : {40U, 100U, 1000U}) EXPECT_TRUE(sites.run(size));
  }
}

TEST(bulk_nasty, antipodes_hemispheres_and_duplicates) {
  Random random(18);
  SiteSet set;
  for (int k = 0; k < 400; ++k) {
    const Point p = random_direction(random);
    set.sites.push_back(p);
    set.sites.push_back(-1.0 * p);
    if (k % 2 == 0) set.sites.push_back(p);
    if (k % 3 == 0) set.sites.push_back(2.0 * p);
  }
  expect_same(set, {40, 100, 1000});
  for (Point& p : set.sites) p.z = std::abs(p.z);
  expect_same(set, {40, 100, 1000});
}

// Differences from the center that overflow.
TEST(bulk_nasty, centers_at_the_end_of_the_range) {
  Random random(19);
  SiteSet set;
  set.sphere.center = {-1.2e308, 0, 0};
  for (int k = 0; k < 200; ++k) set.sites.push_back(1.5e308 * random_direction(random));
  expect_same(set, {40, 100, 1000});
}

}  // namespace
}  // namespace rondel::test
