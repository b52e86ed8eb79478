// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The coasts that globes and figures show.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rondel/globe.h"

namespace rondel::test {
namespace {

TEST(coast_lines, are_closed_and_one_of_them_goes_around_a_pole) {
  const CoastLines coast = coast_lines();
  ASSERT_EQ(coast.offsets.size(), 127U);
  ASSERT_EQ(coast.offsets.back(), coast.positions.size());
  EXPECT_EQ(coast.positions.size(), 126U + 4'995U);
  int around_a_pole = 0;
  for (std::size_t line = 0; line + 1 < coast.offsets.size(); ++line) {
    const LonLat& first = coast.positions[coast.offsets[line]];
    const LonLat& last = coast.positions[coast.offsets[line + 1] - 1];
    EXPECT_EQ(first.lat_deg, last.lat_deg);
    const double turn = std::abs(last.lon_deg - first.lon_deg);
    EXPECT_TRUE(std::abs(turn) < 1e-9 || std::abs(turn - 360) < 1e-9) << turn;
    around_a_pole += turn > 180 ? 1 : 0;
  }
  EXPECT_EQ(around_a_pole, 1);
  for (const LonLat& p : coast.positions) ASSERT_LE(std::abs(p.lat_deg), 90);
}

// Of 510 million square kilometres 149 are land, some of it under the ice shelves that maps show.
TEST(coast_lines, surround_as_much_land_as_there_is) {
  constexpr double degree = std::numbers::pi / 180;
  const CoastLines coast = coast_lines();
  double sum = 0;
  for (std::size_t line = 0; line + 1 < coast.offsets.size(); ++line) {
    double area = 0;
    for (auto i = coast.offsets[line]; i + 1 < coast.offsets[line + 1]; ++i) {
      const LonLat& p = coast.positions[i];
      const LonLat& q = coast.positions[i + 1];
      // To the south pole below the middle of the step.
      area += (p.lon_deg - q.lon_deg) * (1 + std::sin((p.lat_deg + q.lat_deg) / 2 * degree));
    }
    sum += std::abs(area) * degree;
  }
  EXPECT_NEAR(sum / (4 * std::numbers::pi), 149.0 / 510, 0.01);
}

}  // namespace
}  // namespace rondel::test
