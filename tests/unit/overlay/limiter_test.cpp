// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values of order 2 that are limited: bounds of the sources, the integral of before, and no change
// where nothing is out of bounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "rondel/remap.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// The area of a target that sources with values cover.
long double area_with_values(const Remap& remap, const std::vector<double>& sources,
                             std::size_t j) {
  long double area = 0;
  for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
    if (!std::isnan(sources[remap.pieces.values[k]])) area += remap.areas[k];
  }
  return area;
}

// The value of the target divided by the mean over the sources that have values.
double share_of(const Remap& remap, const std::vector<double>& sources, bool keeps_sums,
                std::size_t j) {
  const double covered = remap.target_areas[j] * remap.target_fractions[j];
  const double part =
      keeps_sums ? static_cast<double>(area_with_values(remap, sources, j)) / covered : 1;
  return remap.norm == RemapNorm::fracarea ? part : part * remap.target_fractions[j];
}

// The integral over what sources with values cover of the targets that have values.
long double integral_of(const Remap& remap, const std::vector<double>& sources,
                        const std::vector<double>& values, bool keeps_sums) {
  long double sum = 0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (std::isnan(values[j])) continue;
    const long double mean = values[j] / share_of(remap, sources, keeps_sums, j);
    sum += area_with_values(remap, sources, j) * mean;
  }
  return sum;
}

struct BoundsOfTarget {
  double low;
  double high;
};
BoundsOfTarget bounds_of(const Remap& remap, const std::vector<double>& sources, std::size_t j) {
  BoundsOfTarget bounds{1e300, -1e300};
  for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
    const double value = sources[remap.pieces.values[k]];
    if (std::isnan(value)) continue;
    bounds = {std::min(bounds.low, value), std::max(bounds.high, value)};
  }
  return bounds;
}

void expect_limited(const Remap& remap, const std::vector<double>& sources,
                    const ApplyOptions& options) {
  std::vector<double> plain(remap.target_areas.size());
  std::vector<double> limited(remap.target_areas.size());
  apply(remap.weights, sources, plain, 1, options);
  apply_limited(remap, sources, limited, 1, options);
  double largest = 1;
  std::size_t num_beyond = 0;
  for (std::size_t j = 0; j < limited.size(); ++j) {
    ASSERT_EQ(std::isnan(plain[j]), std::isnan(limited[j])) << j;
    if (std::isnan(limited[j])) continue;
    const double share = share_of(remap, sources, options.keeps_sums, j);
    const auto [low, high] = bounds_of(remap, sources, j);
    const double rounding = 4e-16 * std::max(std::abs(low), std::abs(high));
    EXPECT_GE(limited[j], low * share - rounding) << j;
    EXPECT_LE(limited[j], high * share + rounding) << j;
    if (plain[j] < low * share || plain[j] > high * share) ++num_beyond;
    largest = std::max(largest, std::abs(limited[j]));
  }
  EXPECT_GT(num_beyond, 0U);
  const auto integral = [&](const std::vector<double>& values) {
    return integral_of(remap, sources, values, options.keeps_sums);
  };
  EXPECT_NEAR(static_cast<double>(integral(limited) - integral(plain)), 0,
              1e-14 * 4 * 3.2 * largest);
}

TEST(overlay_limiter, bounds_and_integrals_are_kept) {
  std::mt19937 random(3);
  for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
    const CellSet source = CellSet::voronoi(triangulation_of("uniform", 300, 1));
    const CellSet target = CellSet::voronoi(triangulation_of("uniform", 2000, 2));
    Remap remap = rondel::remap(source, target, {.order = 2, .norm = norm});
    std::vector<double> step(300);
    for (double& value : step) value = random() % 2 == 0 ? 0 : 1;
    expect_limited(remap, step, {});
    for (double& value : step) value = std::uniform_real_distribution<double>(-5, 9)(random);
    expect_limited(remap, step, {});
    std::vector<std::int32_t> has_value(300, 1);
    for (std::size_t i = 0; i < 300; i += 3) {
      step[i] = no_value;
      has_value[i] = 0;
    }
    remap.weights = weights_with_values(remap, has_value);
    for (const double max_missing : {0.3, 1.0}) {
      expect_limited(remap, step, {.max_missing = max_missing});
      expect_limited(remap, step, {.max_missing = max_missing, .keeps_sums = true});
    }
  }
}

// A constant with gaps is within its bounds, so that nothing is to limit.
TEST(overlay_limiter, constants_with_gaps_stay) {
  const CellSet source = NamedGrid("grid:10").cells();
  const CellSet target = NamedGrid("grid:20").cells();
  std::vector<double> values(source.num_cells(), 7);
  std::vector<std::int32_t> has_value(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 7 < 2) values[i] = no_value;
    if (i % 7 < 2) has_value[i] = 0;
  }
  for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
    Remap remap = rondel::remap(source, target, {.order = 2, .norm = norm});
    remap.weights = weights_with_values(remap, has_value);
    const ApplyOptions options{.max_missing = 1, .keeps_sums = norm == RemapNorm::destarea};
    std::vector<double> limited(target.num_cells());
    apply_limited(remap, values, limited, 1, options);
    for (std::size_t j = 0; j < limited.size(); ++j) {
      const double share = share_of(remap, values, options.keeps_sums, j);
      EXPECT_NEAR(limited[j], 7 * share, 1e-13) << j;
    }
  }
}

TEST(overlay_limiter, parts_of_the_sphere_are_limited_as_well) {
  std::vector<double> lines;
  for (int k = 0; k <= 20; ++k) lines.push_back(3.0 * k);
  const CellSet source = CellSet::lonlat_grid({lines, {-20, -10, 0, 10, 20, 30}});
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 3000, 5));
  std::mt19937 random(8);
  std::vector<double> values(source.num_cells());
  for (double& value : values) value = random() % 3 == 0 ? 4 : 1;
  for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
    expect_limited(rondel::remap(source, target, {.order = 2, .norm = norm}), values, {});
  }
}

TEST(overlay_limiter, values_within_bounds_stay) {
  const CellSet source = CellSet::voronoi(triangulation_of("uniform", 500, 1));
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 200, 2));
  const Remap remap = rondel::remap(source, target, {.order = 1});
  std::vector<double> values(500);
  std::mt19937 random(8);
  for (double& value : values) value = std::uniform_real_distribution<double>(0, 1)(random);
  std::vector<double> plain(200);
  std::vector<double> limited(200);
  apply(remap.weights, values, plain);
  apply_limited(remap, values, limited);
  for (std::size_t j = 0; j < 200; ++j) EXPECT_NEAR(limited[j], plain[j], 1e-15);
}

// A source without a value is what a masked one is: weights for fields that lack it are those of a
// remapping without it, and a linear field has no error at the coast.
TEST(overlay_gaps, weights_are_those_of_a_mask) {
  const CellSet source = CellSet::voronoi(triangulation_of("uniform", 2000, 1));
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 300, 2));
  std::vector<std::int32_t> has_value;
  std::vector<double> values;
  const std::vector<Point> centers = source.centers();
  for (const Point& center : centers) {
    has_value.push_back(center.z > 0.3 * center.x ? 1 : 0);
    values.push_back(has_value.back() == 0 ? no_value : center.x - 2 * center.y);
  }
  for (const RemapNorm norm : {RemapNorm::destarea, RemapNorm::fracarea}) {
    const Remap all = rondel::remap(source, target, {.order = 2, .norm = norm});
    EXPECT_EQ(weights_with_values(all, std::vector<std::int32_t>(2000, 1)), all.weights);
    const Weights weights = weights_with_values(all, has_value);
    const Remap masked = rondel::remap(
        source, target, {.order = 2, .norm = RemapNorm::fracarea, .source_mask = has_value});
    std::vector<double> found(300);
    std::vector<double> plain(300);
    std::vector<double> wanted(300);
    const ApplyOptions options{.max_missing = 1};
    apply(weights, values, found, 1, options);
    apply(all.weights, values, plain, 1, options);
    apply(masked.weights, values, wanted, 1, options);
    double largest = 0;
    for (std::size_t j = 0; j < 300; ++j) {
      ASSERT_EQ(std::isnan(found[j]), std::isnan(wanted[j])) << j;
      if (std::isnan(found[j])) continue;
      EXPECT_NEAR(found[j], wanted[j], 1e-11) << j;
      largest = std::max(largest, std::abs(plain[j] - wanted[j]));
    }
    EXPECT_GT(largest, 1e-3) << "without them the coast is wrong";
  }
  const Remap first = rondel::remap(source, target, {.order = 1});
  EXPECT_THROW((void)weights_with_values(first, has_value), InvalidInput);
  const Remap second = rondel::remap(source, target, {.order = 2});
  EXPECT_THROW((void)weights_with_values(second, std::vector<std::int32_t>(3, 1)), InvalidInput);
}

// Which fields were carried before, and which limit they had, changes nothing.
TEST(overlay_gaps, fields_have_the_weights_of_their_own_gaps) {
  const CellSet source = CellSet::voronoi(triangulation_of("uniform", 500, 1));
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 100, 2));
  const Remap remap = rondel::remap(source, target, {.order = 2, .norm = RemapNorm::fracarea});
  std::vector<std::vector<double>> fields(3);
  const std::vector<Point> centers = source.centers();
  for (std::size_t f = 0; f < 3; ++f) {
    for (const Point& center : centers) {
      const bool is_missing = f > 0 && center.z > (f == 1 ? 0.1 : -0.3) * center.x;
      fields[f].push_back(is_missing ? no_value : center.x - 2 * center.y);
    }
  }
  std::vector<std::int32_t> covered(100, 1);
  covered[7] = 0;
  SecondOrderRemap kept(remap, covered);
  for (const std::size_t f : {1U, 0U, 2U, 2U, 1U, 0U}) {
    for (const double share : {1.0, 0.3, 0.0}) {
      std::vector<std::int32_t> has_value;
      for (const double value : fields[f]) has_value.push_back(std::isnan(value) ? 0 : 1);
      std::vector<double> wanted(100);
      apply(weights_with_values(remap, has_value), fields[f], wanted, 1, {.max_missing = 1});
      for (std::size_t j = 0; j < 100; ++j) {
        double all = 0;
        double missing = 0;
        for (std::uint64_t k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
          all += remap.areas[k];
          missing += has_value[remap.pieces.values[k]] == 0 ? remap.areas[k] : 0;
        }
        if (missing > (share + 1e-9) * all || covered[j] == 0) wanted[j] = no_value;
      }
      std::vector<double> found(100);
      kept.apply(fields[f], found, {.max_missing = share});
      for (std::size_t j = 0; j < 100; ++j) {
        ASSERT_EQ(std::isnan(found[j]), std::isnan(wanted[j])) << j;
        if (std::isnan(found[j])) continue;
        EXPECT_EQ(found[j], wanted[j]) << j;
      }
    }
  }
  std::vector<double> out(100);
  EXPECT_THROW(kept.apply(fields[0], out, {.max_missing = 2}), InvalidInput);
  out.resize(99);
  EXPECT_THROW(kept.apply(fields[0], out), InvalidInput);
  EXPECT_THROW(SecondOrderRemap(remap, {1, 0}), InvalidInput);
  EXPECT_THROW(SecondOrderRemap(rondel::remap(source, target)), InvalidInput);
}

// All fields of a call are limited by themselves, for any number of threads.
TEST(overlay_limiter, fields_do_not_touch_each_other) {
  const CellSet source = CellSet::voronoi(triangulation_of("uniform", 200, 1));
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 900, 2));
  const Remap remap = rondel::remap(source, target, {.order = 2});
  std::mt19937 random(8);
  std::vector<double> values(600);
  for (double& value : values) value = random() % 2 == 0 ? 0 : 1;
  std::vector<double> all(2700);
  apply_limited(remap, values, all, 3, {}, {.threads = 3});
  for (std::size_t f = 0; f < 3; ++f) {
    const auto first = static_cast<std::ptrdiff_t>(200 * f);
    const std::vector<double> one(values.begin() + first, values.begin() + first + 200);
    std::vector<double> limited(900);
    apply_limited(remap, one, limited, 1, {}, {.threads = 1});
    EXPECT_TRUE(std::equal(limited.begin(), limited.end(),
                           all.begin() + static_cast<std::ptrdiff_t>(900 * f)));
  }
}

}  // namespace
}  // namespace rondel::test
