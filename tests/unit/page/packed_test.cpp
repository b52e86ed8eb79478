// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays as a page holds them: planes, zlib streams, base64.
#include "page/packed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rondel/globe.h"
#include "support/page_reader.h"

namespace rondel::test {
namespace {

std::string random_bytes(std::size_t size, unsigned values) {
  std::mt19937_64 random(3);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % values);
  return bytes;
}

TEST(base64, is_that_of_rfc_4648) {
  EXPECT_EQ(page::base64(""), "");
  EXPECT_EQ(page::base64("f"), "Zg==");
  EXPECT_EQ(page::base64("fo"), "Zm8=");
  EXPECT_EQ(page::base64("foo"), "Zm9v");
  EXPECT_EQ(page::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(page::base64("\xff\xfe\xfd"), "//79");
}

TEST(in_planes, puts_bytes_of_one_place_together) {
  EXPECT_EQ(page::in_planes("abcdABCD", 4), "aAbBcCdD");
  EXPECT_EQ(page::in_planes("abc", 1), "abc");
  EXPECT_EQ(page::in_planes("", 8), "");
}

TEST(zlib_stream, is_read_by_zlib_at_any_length) {
  constexpr std::size_t piece = 1 << 20;
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, piece - 1, piece, piece + 1, 3 * piece + 17}) {
    for (const unsigned values : {2U, 256U}) {
      const std::string bytes = random_bytes(size, values);
      EXPECT_EQ(inflated(page::zlib_stream(bytes, 2), size), bytes) << size;
    }
  }
}

TEST(zlib_stream, does_not_depend_on_the_number_of_threads) {
  const std::string bytes = random_bytes(5'000'000, 16);
  const std::string one = page::zlib_stream(bytes, 1);
  EXPECT_LT(one.size(), bytes.size() * 6 / 10);
  EXPECT_EQ(one, page::zlib_stream(bytes, 4));
}

// The coasts that globes and figures show.

TEST(coast_lines, are_closed_and_one_of_them_goes_around_a_pole) {
  const CompressedRows<LonLat> coast = coast_lines();
  ASSERT_EQ(coast.offsets.size(), 127U);
  ASSERT_EQ(coast.offsets.back(), coast.values.size());
  EXPECT_EQ(coast.values.size(), 126U + 4'995U);
  int around_a_pole = 0;
  for (std::size_t line = 0; line + 1 < coast.offsets.size(); ++line) {
    const LonLat& first = coast.values[coast.offsets[line]];
    const LonLat& last = coast.values[coast.offsets[line + 1] - 1];
    EXPECT_EQ(first.lat_deg, last.lat_deg);
    const double turn = std::abs(last.lon_deg - first.lon_deg);
    EXPECT_TRUE(std::abs(turn) < 1e-9 || std::abs(turn - 360) < 1e-9) << turn;
    around_a_pole += turn > 180 ? 1 : 0;
  }
  EXPECT_EQ(around_a_pole, 1);
  for (const LonLat& p : coast.values) ASSERT_LE(std::abs(p.lat_deg), 90);
}

// Of 510 million square kilometres 149 are land, some of it under the ice shelves that maps show.
TEST(coast_lines, surround_as_much_land_as_there_is) {
  constexpr double degree = std::numbers::pi / 180;
  const CompressedRows<LonLat> coast = coast_lines();
  double sum = 0;
  for (std::size_t line = 0; line + 1 < coast.offsets.size(); ++line) {
    double area = 0;
    for (auto i = coast.offsets[line]; i + 1 < coast.offsets[line + 1]; ++i) {
      const LonLat& p = coast.values[i];
      const LonLat& q = coast.values[i + 1];
      // To the south pole below the middle of the step.
      area += (p.lon_deg - q.lon_deg) * (1 + std::sin((p.lat_deg + q.lat_deg) / 2 * degree));
    }
    sum += std::abs(area) * degree;
  }
  EXPECT_NEAR(sum / (4 * std::numbers::pi), 149.0 / 510, 0.01);
}

}  // namespace
}  // namespace rondel::test
