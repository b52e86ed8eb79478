// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Monotone slopes of order 2: values stay within those of the sources around, each source keeps its integral,
// linear fields are not limited, and constants are exact.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "rondel/named_grids.h"
#include "rondel/remap.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double no_slope_value = std::numeric_limits<double>::quiet_NaN();

// For each cell the cells that share a corner with it, and itself.
using CellsAround = std::vector<std::set<std::size_t>>;

CellsAround around_by_rings(const CellSet& cells) {
  const CellRings rings = cells.rings();
  std::map<std::vector<double>, std::set<std::size_t>> at;
  std::vector<std::vector<std::vector<double>>> corners(cells.num_cells());
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    for (auto r = rings.cells[i]; r < rings.cells[i + 1]; ++r) {
      for (auto k = rings.rings[r]; k < rings.rings[r + 1]; ++k) {
        const Point& p = rings.points[rings.corners[k]];
        corners[i].push_back({p.x, p.y, p.z});
        at[corners[i].back()].insert(i);
      }
    }
  }
  CellsAround around(cells.num_cells());
  for (std::size_t i = 0; i < around.size(); ++i) {
    around[i].insert(i);
    for (const auto& corner : corners[i]) around[i].insert(at[corner].begin(), at[corner].end());
  }
  return around;
}

// Those of a grid of the whole sphere, latitude by latitude; all cells of a polar row share the pole.
CellsAround around_in_grid(std::size_t columns, std::size_t rows) {
  CellsAround around(columns * rows);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::size_t row = i / columns;
    for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, rows - 1); ++r) {
      const bool is_all = r == row && (row == 0 || row + 1 == rows);
      for (std::size_t step = 0; step < (is_all ? columns : 3); ++step) {
        around[i].insert(r * columns + (i % columns + columns + step - 1) % columns);
      }
    }
  }
  return around;
}

struct SlopesCase {
  CellSet source;
  CellSet target;
  CellsAround around;
};

std::vector<SlopesCase> slopes_cases() {
  const CellSet diagram = CellSet::voronoi(triangulation_of("uniform", 300, 1));
  const CellSet triangles = CellSet::triangles(triangulation_of("uniform", 300, 4));
  const CellSet fine = CellSet::voronoi(triangulation_of("uniform", 3000, 2));
  const CellSet pixels = NamedGrid("healpix:2").cells();
  const CellSet grid = NamedGrid("grid:10").cells();
  return {{diagram, fine, around_by_rings(diagram)},
          {triangles, fine, around_by_rings(triangles)},
          {pixels, NamedGrid("grid:3").cells(), around_by_rings(pixels)},
          {grid, NamedGrid("healpix:5").cells(), around_in_grid(36, 18)},
          {grid, NamedGrid("grid:4x3").cells(), around_in_grid(36, 18)}};
}

std::vector<double> applied(const Remap& remap, const std::vector<double>& field,
                            RemapLimiter limiter, const ApplyOptions& rules = {},
                            unsigned threads = 1) {
  std::vector<double> out(remap.target_areas.size());
  SecondOrderRemap(remap, {}, limiter).apply(field, out, rules, {.threads = threads});
  return out;
}

long double integral_of(const Remap& remap, const std::vector<double>& values) {
  long double sum = 0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (!std::isnan(values[j])) sum += static_cast<long double>(remap.target_areas[j]) * values[j];
  }
  return sum;
}

// Expects each value within those of the sources around the sources of its target.
void expect_within(const SlopesCase& c, const Remap& remap, const std::vector<double>& field,
                   const std::vector<double>& values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k) {
      if (std::isnan(field[remap.pieces.values[k]])) continue;
      for (const std::size_t i : c.around[remap.pieces.values[k]]) {
        if (std::isnan(field[i])) continue;
        low = std::min(low, field[i]);
        high = std::max(high, field[i]);
      }
    }
    if (std::isnan(values[j])) {
      EXPECT_GT(low, high) << j;
      continue;
    }
    EXPECT_GE(values[j], low) << j;
    EXPECT_LE(values[j], high) << j;
  }
}

TEST(overlay_slopes, values_are_within_those_around_and_integrals_are_kept) {
  std::mt19937 random(3);
  for (const SlopesCase& c : slopes_cases()) {
    const Remap remap = rondel::remap(c.source, c.target, {.order = 2});
    std::vector<double> step(c.source.num_cells());
    for (double& value : step) value = random() % 2 == 0 ? 0 : 1;
    std::vector<double> any(step.size());
    for (double& value : any) value = std::uniform_real_distribution<double>(-5, 9)(random);
    for (const std::vector<double>& field : {step, any}) {
      const std::vector<double> plain = applied(remap, field, RemapLimiter::none);
      const std::vector<double> limited = applied(remap, field, RemapLimiter::slopes);
      expect_within(c, remap, field, limited);
      EXPECT_NE(plain, limited);
      EXPECT_NEAR(static_cast<double>(integral_of(remap, limited) - integral_of(remap, plain)), 0,
                  1e-14 * 9 * 12.6);
      EXPECT_EQ(limited, applied(remap, field, RemapLimiter::slopes, {}, 3));
    }
  }
}

// The slopes alone, without the last step that takes rounding out of means, keep the bounds: each piece of a
// source has its own target here.
TEST(overlay_slopes, every_piece_keeps_the_integral_of_its_source) {
  const CellSet source = CellSet::voronoi(triangulation_of("uniform", 100, 1));
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 20000, 2));
  const Remap remap = rondel::remap(source, target, {.order = 2});
  std::vector<double> field(100);
  for (std::size_t i = 0; i < 100; ++i) field[i] = i % 7 == 0 ? 1 : 0;
  const std::vector<double> limited = applied(remap, field, RemapLimiter::slopes);
  const std::vector<double> plain = applied(remap, field, RemapLimiter::none);
  // The sum over targets that are in one source alone, with what is missing at its border, is its integral
  // in both.
  const long double difference = integral_of(remap, limited) - integral_of(remap, plain);
  EXPECT_NEAR(static_cast<double>(difference), 0, 1e-14 * 12.6);
  for (const double value : limited) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  std::size_t num_between = 0;
  for (const double value : limited) num_between += value > 0.01 && value < 0.99 ? 1 : 0;
  EXPECT_GT(num_between, 500U) << "slopes are left";
}

TEST(overlay_slopes, linear_fields_stay) {
  for (const SlopesCase& c : slopes_cases()) {
    const Remap remap = rondel::remap(c.source, c.target, {.order = 2});
    std::vector<double> field;
    for (const Point& m : remap.source_centers) field.push_back(m.x - 2 * m.y + 0.5 * m.z);
    const std::vector<double> plain = applied(remap, field, RemapLimiter::none);
    const std::vector<double> limited = applied(remap, field, RemapLimiter::slopes);
    std::size_t num_same = 0;
    for (std::size_t j = 0; j < plain.size(); ++j) {
      num_same += std::abs(plain[j] - limited[j]) < 1e-14 ? 1 : 0;
    }
    // The others are near the two extremes that a linear field has on the sphere, and in cells of random
    // sites whose corners are beyond the centers around them.
    EXPECT_GT(num_same, plain.size() * 70 / 100) << c.source.num_cells();
  }
}

TEST(overlay_slopes, sources_without_a_value_do_not_count) {
  std::mt19937 random(8);
  for (const SlopesCase& c : slopes_cases()) {
    for (const RemapNorm norm : {RemapNorm::fracarea, RemapNorm::destarea}) {
      const Remap remap = rondel::remap(c.source, c.target, {.order = 2, .norm = norm});
      std::vector<double> field(c.source.num_cells());
      std::vector<double> constant(field.size(), 280.1);
      for (std::size_t i = 0; i < field.size(); ++i) {
        field[i] = random() % 3 == 0 ? no_slope_value : random() % 2 == 0 ? 0 : 1;
        if (std::isnan(field[i])) constant[i] = no_slope_value;
      }
      expect_within(c, remap, field,
                    applied(remap, field, RemapLimiter::slopes, {.max_missing = 1}));
      for (const double value :
           applied(remap, constant, RemapLimiter::slopes, {.max_missing = 1})) {
        EXPECT_TRUE(std::isnan(value) || value == 280.1) << value;
      }
      // Sums keep what the sources that are there have.
      const ApplyOptions sums{.max_missing = 1, .keeps_sums = true};
      const std::vector<double> kept = applied(remap, field, RemapLimiter::slopes, sums);
      long double wanted = 0;
      for (std::size_t k = 0; k < remap.areas.size(); ++k) {
        const double value = field[remap.pieces.values[k]];
        if (!std::isnan(value)) wanted += static_cast<long double>(remap.areas[k]) * value;
      }
      EXPECT_NEAR(static_cast<double>(integral_of(remap, kept) - wanted), 0, 2e-13);
    }
  }
}

// A masked source is what one without a value is.
TEST(overlay_slopes, a_region_and_a_mask_are_limited_as_well) {
  std::vector<double> lines;
  for (int k = 0; k <= 20; ++k) lines.push_back(3.0 * k);
  const CellSet source = CellSet::lonlat_grid({lines, {30, 20, 10, 0, -10, -20}});
  const CellSet target = CellSet::voronoi(triangulation_of("uniform", 3000, 5));
  std::mt19937 random(8);
  std::vector<double> field(source.num_cells());
  std::vector<std::int32_t> mask(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    field[i] = random() % 3 == 0 ? 4 : 1;
    mask[i] = random() % 5 == 0 ? 0 : 1;
  }
  const Remap whole = rondel::remap(source, target, {.order = 2, .norm = RemapNorm::fracarea});
  const Remap masked =
      rondel::remap(source, target, {.order = 2, .norm = RemapNorm::fracarea, .source_mask = mask});
  std::vector<double> with_gaps = field;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) with_gaps[i] = no_slope_value;
  }
  const std::vector<double> a = applied(masked, field, RemapLimiter::slopes);
  const std::vector<double> b = applied(whole, with_gaps, RemapLimiter::slopes, {.max_missing = 1});
  for (std::size_t j = 0; j < a.size(); ++j) {
    ASSERT_EQ(std::isnan(a[j]), std::isnan(b[j])) << j;
    if (std::isnan(a[j])) continue;
    EXPECT_NEAR(a[j], b[j], 1e-12) << j;
    EXPECT_TRUE(a[j] >= 1 && a[j] <= 4) << a[j];
  }
}

}  // namespace
}  // namespace rondel::test
