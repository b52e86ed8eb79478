// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sources given to their nearest targets, against all distances in exact arithmetic, and weights of
// a part of targets and sites.

#include "rondel/regrid.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "rondel/weights.h"
#include "support/thrown.h"
#include "unit/interpolation/support.h"

namespace rondel::test {
namespace {

// Integer points on the sphere around 0 with a squared radius of 9: distances are dot products.
std::vector<Point> points_of_nine() {
  std::vector<Point> points;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      for (int z = -3; z <= 3; ++z) {
        if (x * x + y * y + z * z == 9) {
          points.push_back(
              {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  return points;
}

double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

TEST(regrid, each_source_is_given_to_its_nearest_target) {
  const std::vector<Point> all = points_of_nine();
  std::vector<Point> targets;
  std::vector<Point> sources;
  for (std::size_t k = 0; k < all.size(); ++k) (k % 3 == 0 ? targets : sources).push_back(all[k]);
  sources.push_back(targets[1]);
  const Triangulation triangulation = delaunay(targets, {.sphere = {.squared_radius = 9}});
  const Interpolator interpolator(triangulation);
  const Weights weights = nearest_d2s_weights(interpolator, sources);
  ASSERT_EQ(weights.num_rows(), targets.size());
  EXPECT_EQ(weights.num_columns, sources.size());
  EXPECT_EQ(weights.sites_hash, point_set_hash(sources));
  EXPECT_EQ(weights.targets_hash, point_set_hash(targets));
  std::vector<int> times(sources.size());
  for (std::size_t r = 0; r < targets.size(); ++r) {
    const WeightRow row = row_of(weights, r);
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      const Point& source = sources[row.columns[k]];
      EXPECT_EQ(row.values[k], 1);
      ++times[row.columns[k]];
      EXPECT_TRUE(k == 0 || row.columns[k - 1] < row.columns[k]);
      for (const Point& other : targets) EXPECT_GE(dot(source, targets[r]), dot(source, other));
    }
  }
  EXPECT_EQ(times, std::vector<int>(sources.size(), 1));
}

TEST(regrid, only_one_of_several_targets_in_one_place_is_given_something) {
  const std::vector<Point> targets = {{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const Triangulation triangulation = delaunay(targets);
  const Weights weights =
      nearest_d2s_weights(Interpolator(triangulation), std::vector<Point>{{0, 9, 1}, {1, 3, 1}});
  EXPECT_EQ(weights.offsets, std::vector<std::uint64_t>({0, 0, 2, 2, 2}));
  EXPECT_EQ(weights.columns, std::vector<Index>({0, 1}));
}

TEST(regrid, bad_sources_are_named) {
  const std::vector<Point> targets = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Triangulation triangulation = delaunay(targets);
  const Interpolator interpolator(triangulation);
  for (const Point& bad : {Point{0, 0, 0}, Point{nan, 0, 0}}) {
    EXPECT_EQ(thrown_index([&] {
                return nearest_d2s_weights(interpolator, std::vector<Point>{{1, 0, 0}, bad});
              }),
              1U);
  }
}

TEST(regrid, methods_have_the_names_of_esmf) {
  EXPECT_EQ(name_of(RegridMethod::bilinear), "bilinear");
  EXPECT_EQ(name_of(RegridMethod::nearest_d2s), "nearest_d2s");
  EXPECT_EQ(name_of(RegridMethod::native), "native");
  EXPECT_EQ(name_of(static_cast<RegridMethod>(3)), "");
}

// Rows {1: 0.25, 3: 0.75}, {} and {0: 0.5, 1: 0.25, 2: 0.25}.
const Weights of_a_part = {.offsets = {0, 2, 2, 5},
                           .columns = {1, 3, 0, 1, 2},
                           .values = {0.25, 0.75, 0.5, 0.25, 0.25},
                           .num_columns = 4,
                           .sites_hash = 7,
                           .targets_hash = 8};

TEST(regrid, rows_and_columns_get_other_numbers) {
  const Weights found =
      renumbered(of_a_part, std::vector<Index>{3, 0, 1}, 5, std::vector<Index>{9, 2, 5, 2}, 10);
  const Weights wanted = {.offsets = {0, 0, 3, 3, 5, 5},
                          .columns = {9, 2, 5, 2, 2},
                          .values = {0.5, 0.25, 0.25, 0.25, 0.75},
                          .num_columns = 10};
  EXPECT_EQ(found, wanted);
}

TEST(regrid, numbers_that_do_not_fit_are_refused) {
  using Numbers = std::vector<Index>;
  const Numbers rows = {0, 1, 2};
  const Numbers columns = {0, 1, 2, 3};
  const auto index_of = [&](const Numbers& row_numbers, const Numbers& column_numbers) {
    return thrown_index([&] { return renumbered(of_a_part, row_numbers, 3, column_numbers, 4); });
  };
  EXPECT_EQ(index_of(rows, columns), 99U);
  EXPECT_EQ(index_of({0, 1}, columns), InvalidInput::no_index);
  EXPECT_EQ(index_of(rows, {0, 1, 2}), InvalidInput::no_index);
  EXPECT_EQ(index_of({0, 3, 2}, columns), 1U);
  EXPECT_EQ(index_of({0, 2, 2}, columns), 2U);
  EXPECT_EQ(index_of(rows, {0, 1, 2, 4}), 3U);
}

TEST(regrid, rows_are_replaced_by_empty_ones_or_by_those_of_others) {
  const std::vector<std::int32_t> mask = {0, 0, 5};
  Weights wanted = of_a_part;
  wanted.offsets = {0, 0, 0, 3};
  wanted.columns = {0, 1, 2};
  wanted.values = {0.5, 0.25, 0.25};
  EXPECT_EQ(with_rows(of_a_part, mask), wanted);
  const Weights others = {
      .offsets = {0, 0, 1, 2}, .columns = {2, 3}, .values = {1, 1}, .num_columns = 4};
  wanted.offsets = {0, 0, 1, 4};
  wanted.columns = {2, 0, 1, 2};
  wanted.values = {1, 0.5, 0.25, 0.25};
  EXPECT_EQ(with_rows(of_a_part, mask, &others), wanted);
  Weights wider = others;
  wider.num_columns = 5;
  EXPECT_THROW((void)with_rows(of_a_part, mask, &wider), InvalidInput);
  EXPECT_THROW((void)with_rows(of_a_part, std::vector<std::int32_t>(4)), InvalidInput);
}

TEST(regrid, rows_that_need_a_column_without_part_are_empty) {
  const auto offsets_without = [](std::vector<std::int32_t> mask) {
    return without_columns(of_a_part, mask).offsets;
  };
  using Offsets = std::vector<std::uint64_t>;
  EXPECT_EQ(offsets_without({1, 1, 1, 1}), of_a_part.offsets);
  EXPECT_EQ(offsets_without({1, 1, 1, 0}), Offsets({0, 0, 0, 3}));
  EXPECT_EQ(offsets_without({1, 1, 0, 1}), Offsets({0, 2, 2, 2}));
  EXPECT_EQ(offsets_without({1, 0, 1, 1}), Offsets({0, 0, 0, 0}));
  EXPECT_THROW(offsets_without({1, 1, 1}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
