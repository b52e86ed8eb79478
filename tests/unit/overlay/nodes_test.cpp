// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Nodes between the centers of a grid, against the nodes of grids that have both.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"

namespace rondel::test {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// A grid of steps of a tenth of a degree along turned axes, so that neither longitudes nor latitudes
// are along rows or columns.
LonLat turned(double i, double j) { return {10 + 0.1 * i - 0.05 * j, 20 + 0.05 * i + 0.1 * j}; }

std::vector<LonLat> turned_centers(std::size_t rows, std::size_t columns) {
  std::vector<LonLat> centers;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      centers.push_back(turned(static_cast<double>(i), static_cast<double>(j)));
    }
  }
  return centers;
}

double apart(const LonLat& a, const LonLat& b) { return norm(unit_vector(a) - unit_vector(b)); }

TEST(nodes_between, are_half_way_and_beyond_the_border) {
  const std::vector<LonLat> nodes = nodes_between(turned_centers(6, 9), {6, 9});
  ASSERT_EQ(nodes.size(), 70U);
  for (std::size_t j = 0; j <= 6; ++j) {
    for (std::size_t i = 0; i <= 9; ++i) {
      const LonLat wanted = turned(static_cast<double>(i) - 0.5, static_cast<double>(j) - 0.5);
      // The grid is bent by less than a thousandth of a step.
      EXPECT_LT(apart(nodes[j * 10 + i], wanted), 2e-6) << i << ' ' << j;
    }
  }
}

TEST(nodes_between, inner_ones_are_means) {
  const std::vector<LonLat> centers = turned_centers(4, 5);
  const std::vector<LonLat> nodes = nodes_between(centers, {4, 5});
  for (std::size_t j = 1; j < 4; ++j) {
    for (std::size_t i = 1; i < 5; ++i) {
      Point sum{0, 0, 0};
      for (const std::size_t k : {j * 5 + i, j * 5 + i - 1, j * 5 + i - 5, j * 5 + i - 6}) {
        sum = sum + unit_vector(centers[k]);
      }
      EXPECT_LT(norm(unit_vector(nodes[j * 6 + i]) - normalized(sum)), 1e-15);
    }
  }
}

TEST(nodes_between, grids_around_the_globe_close) {
  std::vector<LonLat> centers;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 36; ++i) centers.push_back({5.0 + 10 * i, -15.0 + 10 * j});
  }
  const std::vector<LonLat> nodes = nodes_between(centers, {4, 36});
  for (std::size_t j = 0; j <= 4; ++j) {
    EXPECT_EQ(unit_vector(nodes[j * 37]), unit_vector(nodes[j * 37 + 36]));
    EXPECT_NEAR(nodes[j * 37 + 7].lon_deg, 70, 1e-12);
  }
  // Half of the globe does not close.
  const std::vector<LonLat> half = nodes_between(std::span(centers).first(36), {2, 18});
  EXPECT_GT(apart(half[0], half[18]), 0.1);
}

TEST(nodes_between, gaps_are_extrapolated_into) {
  std::vector<LonLat> centers = turned_centers(7, 7);
  const std::vector<LonLat> wanted = nodes_between(centers, {7, 7});
  centers[3 * 7 + 3] = {missing, missing};
  const std::vector<LonLat> nodes = nodes_between(centers, {7, 7});
  for (std::size_t k = 0; k < nodes.size(); ++k) EXPECT_LT(apart(nodes[k], wanted[k]), 2e-6);
  // Alone in a gap, a center has no neighbors to extrapolate from.
  std::vector<LonLat> alone(49, {missing, missing});
  alone[24] = {0, 0};
  EXPECT_TRUE(std::isnan(nodes_between(alone, {7, 7})[27].lon_deg));
}

TEST(nodes_between, lines_of_centers_are_refused) {
  const std::vector<LonLat> centers = turned_centers(1, 9);
  EXPECT_THROW((void)nodes_between(centers, {1, 9}), InvalidInput);
  EXPECT_THROW((void)nodes_between(centers, {9, 1}), InvalidInput);
  EXPECT_THROW((void)nodes_between(centers, {2, 4}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
