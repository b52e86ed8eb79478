// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inside of hostile regions is found for cells of every kind. The oracle computes winding
// numbers of rings with 77 digits (overlay_oracle.h): either pieces are correct up to rounding, or
// it agrees that the rings bound nothing. RONDEL_TEST_SCALE multiplies the number of regions.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/generators.h"
#include "unit/overlay/shapes.h"
#include "unit/overlay/trial.h"

namespace rondel::test {
namespace {

class OverlayInside : public testing::TestWithParam<std::size_t> {};

TEST_P(OverlayInside, pieces_are_those_of_winding_numbers) {
  constexpr std::uint64_t audited_every = 64;
  const std::size_t num_shapes = scaled(10);
  std::size_t num_wrong = 0;
  for (std::uint64_t seed = 0; seed < num_shapes; ++seed) {
    SCOPED_TRACE(std::string(shape_kinds.at(GetParam())) + ' ' + std::to_string(seed));
    const std::vector<Cover>& covers = known_covers(seed % num_cover_sets);
    const std::vector<RingOfPoints> rings =
        hostile_shape(GetParam(), seed, corners_of(covers[seed % 3]));
    Trial trial(rings, seed % audited_every == 7);
    if (trial.is_wrong()) {
      ++num_wrong;
    } else {
      trial.expect_areas();
    }
    for (const Cover& cover : covers) {
      SCOPED_TRACE(cover.name);
      trial.expect_pieces(cover, seed);
    }
    constexpr int most_failures = 30;
    if (testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count() >
        most_failures)
      break;
  }
  RecordProperty("wrong", static_cast<int>(num_wrong));
}

INSTANTIATE_TEST_SUITE_P(overlay, OverlayInside, testing::Range(std::size_t{0}, shape_kinds.size()),
                         [](const auto& test) { return shape_kinds.at(test.param); });

}  // namespace
}  // namespace rondel::test
