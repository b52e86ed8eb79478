// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Statistics of zones, against sums by hand and by the definitions.
#include "rondel/zonal_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

constexpr double gap = std::numeric_limits<double>::quiet_NaN();

// Four cells of areas 1, 2, 4, 4 and two zones: the first one has all of cell 0, half of cell 1 and a
// quarter of cell 2, and 1 more that no cell covers; the second one has nothing.
Remap by_hand() {
  Remap remap;
  remap.pieces.offsets = {0, 3, 3};
  remap.pieces.values = {0, 1, 2};
  remap.areas = {1, 1, 1};
  remap.source_areas = {1, 2, 4, 4};
  remap.target_areas = {4, 2};
  return remap;
}

// Returns a statistic of both zones.
std::vector<double> zones_of(const Remap& remap, const std::string& name,
                             const std::vector<double>& values, const ZonalOptions& options = {}) {
  std::vector<double> out(2);
  zonal_statistics(remap, zonal_statistics_of(name), values, out, 1, options);
  return out;
}

TEST(zonal_statistics, are_those_of_the_definitions) {
  const Remap remap = by_hand();
  const std::vector<double> values = {3, 6, 12, 100};
  const auto first = [&](const std::string& name, const ZonalOptions& options = {}) {
    return zones_of(remap, name, values, options)[0];
  };
  EXPECT_DOUBLE_EQ(first("mean"), 7);
  EXPECT_DOUBLE_EQ(first("sum"), 3 + 6 / 2.0 + 12 / 4.0);
  EXPECT_DOUBLE_EQ(first("count"), 1.75);
  EXPECT_EQ(first("min"), 3);
  EXPECT_EQ(first("max"), 12);
  EXPECT_DOUBLE_EQ(first("fraction"), 0.75);
  EXPECT_DOUBLE_EQ(first("variance"), (16 + 1 + 25) / 3.0);
  EXPECT_DOUBLE_EQ(first("stdev"), std::sqrt(14.0));
  EXPECT_EQ(first("std"), first("stdev"));
  EXPECT_EQ(first("median"), 6);
  EXPECT_DOUBLE_EQ(first("quantile:0.25"), 4.5);
  EXPECT_EQ(first("variety"), 3);
  const ZonalOptions by_share{.weights = ZonalWeights::fraction};
  EXPECT_DOUBLE_EQ(first("mean", by_share), (3 + 6 / 2.0 + 12 / 4.0) / 1.75);
  EXPECT_EQ(first("majority", by_share), 3);
  EXPECT_EQ(first("minority", by_share), 12);
  EXPECT_EQ(first("sum", by_share), first("sum"));
}

TEST(zonal_statistics, of_nothing_are_missing_and_counts_are_zero) {
  for (const char* name : {"mean", "sum", "min", "max", "variance", "stdev", "median",
                           "quantile:0.5", "majority", "minority"}) {
    EXPECT_TRUE(std::isnan(zones_of(by_hand(), name, {3, 6, 12, 100})[1])) << name;
    EXPECT_TRUE(std::isnan(zones_of(by_hand(), name, {gap, gap, gap, 1})[0])) << name;
  }
  for (const char* name : {"count", "fraction", "variety"}) {
    EXPECT_EQ(zones_of(by_hand(), name, {3, 6, 12, 100})[1], 0) << name;
    EXPECT_EQ(zones_of(by_hand(), name, {gap, gap, gap, 1})[0], 0) << name;
  }
}

TEST(zonal_statistics, leave_out_missing_values_up_to_a_share) {
  const std::vector<double> values = {3, gap, 12, 100};
  EXPECT_DOUBLE_EQ(zones_of(by_hand(), "mean", values)[0], 7.5);
  EXPECT_DOUBLE_EQ(zones_of(by_hand(), "count", values)[0], 1.25);
  EXPECT_DOUBLE_EQ(zones_of(by_hand(), "fraction", values)[0], 0.5);
  // A quarter of the zone has no cell, and a third of the cells' part has no value.
  const auto with = [&](double share) {
    return zones_of(by_hand(), "mean", values, {.max_missing = share})[0];
  };
  EXPECT_FALSE(std::isnan(with(0.34)));
  EXPECT_TRUE(std::isnan(with(0.32)));
  const std::vector<double> all = {3, 6, 12, 100};
  EXPECT_FALSE(std::isnan(zones_of(by_hand(), "mean", all, {.max_missing = 0.25})[0]));
  EXPECT_TRUE(std::isnan(zones_of(by_hand(), "mean", all, {.max_missing = 0.24})[0]));
  EXPECT_EQ(zones_of(by_hand(), "variety", all, {.max_missing = 0})[0], 3);
}

TEST(zonal_statistics, of_equal_values_take_the_least_of_several) {
  Remap remap = by_hand();
  EXPECT_EQ(zones_of(remap, "majority", {5, 2, 9, 0})[0], 2);
  EXPECT_EQ(zones_of(remap, "minority", {5, 2, 9, 0})[0], 2);
  EXPECT_EQ(zones_of(remap, "majority", {5, 2, 5, 0})[0], 5);
  EXPECT_EQ(zones_of(remap, "minority", {5, 2, 5, 0})[0], 2);
  EXPECT_EQ(zones_of(remap, "variety", {5, 2, 5, 0})[0], 2);
  EXPECT_EQ(zones_of(remap, "variance", {5, 5, 5, 0})[0], 0);
  EXPECT_EQ(zones_of(remap, "median", {5, 5, 5, 0})[0], 5);
}

// The zone has all of cell 0 and a sliver of cells 1 and 2.
TEST(zonal_statistics, leave_slivers_out_of_extremes_and_quantiles_alone) {
  Remap remap = by_hand();
  remap.areas = {1, 2e-4, 2e-4};
  const std::vector<double> values = {5, 100, -100, 0};
  const auto first = [&](const char* name) { return zones_of(remap, name, values)[0]; };
  for (const char* name : {"min", "max", "median", "quantile:0.99", "majority", "minority"}) {
    EXPECT_EQ(first(name), 5) << name;
  }
  EXPECT_EQ(first("variety"), 1);
  EXPECT_DOUBLE_EQ(first("mean"), 5 / 1.0004);
  EXPECT_DOUBLE_EQ(first("sum"), 5 + 100e-4 - 50e-4);
  EXPECT_DOUBLE_EQ(first("count"), 1 + 1e-4 + 5e-5);
  // Where a zone is that small, or has nothing else, they count.
  remap.target_areas[0] = 1e-4;
  EXPECT_EQ(first("max"), 100);
  remap.target_areas[0] = 4;
  EXPECT_EQ(zones_of(remap, "max", {gap, 100, -100, 0})[0], 100);
}

// A zone of n whole cells of one area.
Remap whole_cells(std::size_t n) {
  Remap remap;
  remap.pieces.offsets = {0, n};
  for (Index i = 0; i < n; ++i) remap.pieces.values.push_back(i);
  remap.areas.assign(n, 0.125);
  remap.source_areas.assign(n, 0.125);
  remap.target_areas = {0.125 * static_cast<double>(n)};
  return remap;
}

TEST(zonal_statistics, quantiles_of_equal_weights_are_of_type_7) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {1U, 2U, 3U, 10U, 101U}) {
    const Remap remap = whole_cells(n);
    std::vector<double> values(n);
    for (double& value : values) value = normal(random);
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    for (const double q : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
      const double at = q * static_cast<double>(n - 1);
      const auto k = std::min(static_cast<std::size_t>(at), n - 1);
      const double upper = sorted[std::min(k + 1, n - 1)];
      const double wanted = sorted[k] + (at - static_cast<double>(k)) * (upper - sorted[k]);
      const ZonalStatistic statistic{ZonalOperation::quantile, q};
      double found = 0;
      zonal_statistics(remap, {&statistic, 1}, values, {&found, 1});
      EXPECT_NEAR(found, wanted, 1e-12) << n << ' ' << q;
    }
  }
}

// The formula of the header for weights 1, 2, 3 and values 10, 20, 40:
// s = 0, 1 * 2 + 2 * 1, 2 * 3 + 2 * 3.
TEST(zonal_statistics, quantiles_heed_weights) {
  Remap remap = whole_cells(3);
  remap.areas = {1, 2, 3};
  remap.source_areas = {1, 2, 3};
  remap.target_areas = {6};
  const std::vector<double> values = {10, 20, 40};
  const auto quantile = [&](double q) {
    const ZonalStatistic statistic{ZonalOperation::quantile, q};
    double found = 0;
    zonal_statistics(remap, {&statistic, 1}, values, {&found, 1});
    return found;
  };
  EXPECT_DOUBLE_EQ(quantile(0), 10);
  EXPECT_DOUBLE_EQ(quantile(2 / 12.0), 15);
  EXPECT_DOUBLE_EQ(quantile(4 / 12.0), 20);
  EXPECT_DOUBLE_EQ(quantile(0.5), 25);
  EXPECT_DOUBLE_EQ(quantile(1), 40);
}

TEST(zonal_statistics, of_many_fields_are_in_order_and_do_not_depend_on_threads) {
  const CellSet grid = CellSet::lonlat_grid(GlobalGrid{36, 18});
  const CellSet zones = CellSet::lonlat_grid(GlobalGrid{7, 5});
  const Remap remap = rondel::remap(grid, zones);
  const auto statistics = zonal_statistics_of("mean,median,majority,count");
  std::mt19937_64 random(2);
  std::vector<double> values(3 * 648);
  for (double& value : values) value = static_cast<double>(random() % 9);
  values[5] = gap;
  std::vector<double> one(4 * 3 * 35);
  std::vector<double> two(one.size());
  zonal_statistics(remap, statistics, values, one, 3, {}, {.threads = 1});
  zonal_statistics(remap, statistics, values, two, 3, {}, {.threads = 2});
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(double)), 0);
  std::vector<double> means(3 * 35);
  apply(remap.weights, values, means, 3, {.max_missing = 1});
  for (std::size_t i = 0; i < means.size(); ++i) EXPECT_NEAR(one[i], means[i], 1e-13);
  double count = 0;
  for (std::size_t z = 0; z < 35; ++z) count += one[3 * 3 * 35 + 35 + z];  // of the second field
  EXPECT_NEAR(count, 648, 1e-10);
}

TEST(zonal_statistics, have_names) {
  const auto all = zonal_statistics_of("mean,quantile:0.1,quantile:1,mode");
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].name(), "mean");
  EXPECT_EQ(all[1].name(), "quantile_0.1");
  EXPECT_EQ(all[2].name(), "quantile_1");
  EXPECT_EQ(all[3].name(), "majority");
  EXPECT_EQ(name_of(ZonalWeights::fraction), "fraction");
  const auto message = [](const char* list) {
    return thrown_message<InvalidInput>([&] { return zonal_statistics_of(list); });
  };
  EXPECT_EQ(message("mean,avg"),
            "'avg' is no statistic; there are mean, sum, count, min, max, fraction, variance, "
            "stdev, median, quantile:Q, majority, minority, variety (Q from 0 to 1)");
  EXPECT_TRUE(message("").starts_with("'' is no statistic"));
  EXPECT_TRUE(message("mean,").starts_with("'' is no statistic"));
  EXPECT_TRUE(message("quantile").starts_with("'quantile' is no statistic"));
  EXPECT_TRUE(message("quantile:1.5").starts_with("'quantile:1.5' is no statistic"));
  EXPECT_TRUE(message("quantile:x").starts_with("'quantile:x' is no statistic"));
  EXPECT_EQ(message("std,stdev"), "the statistic stdev stands twice");
}

TEST(zonal_statistics, refuse_what_does_not_fit) {
  const auto message = [](const Remap& remap, std::size_t in, std::size_t out,
                          const ZonalStatistic& statistic, const ZonalOptions& options) {
    std::vector<double> values(in);
    std::vector<double> numbers(out);
    return thrown_message<InvalidInput>([&] {
      zonal_statistics(remap, {&statistic, 1}, values, numbers, 1, options);
      return 0;
    });
  };
  EXPECT_EQ(message(by_hand(), 4, 2, {}, {}), "");
  EXPECT_EQ(message(by_hand(), 3, 2, {}, {}), "there are 3 values for 1 fields of 4 sources");
  EXPECT_EQ(message(by_hand(), 4, 3, {}, {}), "there is room for 3 numbers where 2 are computed");
  EXPECT_EQ(message(by_hand(), 4, 2, {ZonalOperation::quantile, 2}, {}),
            "the quantile is 2, not in [0, 1]");
  EXPECT_EQ(message(by_hand(), 4, 2, {}, {.max_missing = -1}), "max_missing is -1, not in [0, 1]");
  Remap dropped = by_hand();
  dropped.pieces = {};
  dropped.areas.clear();
  EXPECT_EQ(message(dropped, 4, 2, {}, {}), "the remapping has no pieces");
}

// Zones that overlap have what each of them would have alone.
TEST(zonal_statistics, of_zones_that_overlap_are_those_of_each_alone) {
  const CellSet grid = CellSet::lonlat_grid(GlobalGrid{12, 6});
  const auto box = [](double west, double east, double north) {
    return std::vector<LonLat>{{west, 0}, {east, 0}, {east, north}, {west, north}};
  };
  const std::vector<std::vector<LonLat>> boxes = {box(0, 40, 40), box(20, 70, 50), box(25, 35, 30)};
  std::vector<LonLat> corners;
  for (const auto& one : boxes) corners.insert(corners.end(), one.begin(), one.end());
  const CellSet zones = CellSet::polygons(cells_of_corners(corners, 4));
  EXPECT_THROW(static_cast<void>(remap(grid, zones)), InvalidInput);
  const Remap all = remap(grid, zones, {.overlap = CellOverlap::each});
  for (std::size_t z = 0; z < 3; ++z) {
    const Remap alone = remap(grid, CellSet::polygons(cells_of_corners(boxes[z], 4)));
    EXPECT_NEAR(all.target_areas[z], alone.target_areas[0], 1e-14);
    const std::uint64_t begin = all.pieces.offsets[z];
    ASSERT_EQ(all.pieces.offsets[z + 1] - begin, alone.areas.size()) << z;
    for (std::size_t k = 0; k < alone.areas.size(); ++k) {
      EXPECT_EQ(all.pieces.values[begin + k], alone.pieces.values[k]);
      EXPECT_NEAR(all.areas[begin + k], alone.areas[k], 1e-14);
    }
  }
  // Sources that overlap are refused, as their places would count twice.
  EXPECT_THROW(static_cast<void>(remap(zones, grid, {.overlap = CellOverlap::each})), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
