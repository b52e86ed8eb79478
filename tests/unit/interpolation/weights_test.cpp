// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights in compressed rows, and what applies them.

#include "rondel/weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "unit/interpolation/support.h"

namespace rondel::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Three rows of four columns, the second without entries.
const Weights some = {.offsets = {0, 2, 2, 5},
                      .columns = {1, 3, 0, 1, 2},
                      .values = {0.25, 0.75, 0.5, 0.25, 0.25},
                      .num_columns = 4};

std::vector<double> applied(const std::vector<double>& in, const ApplyOptions& options = {},
                            std::size_t num_fields = 1) {
  std::vector<double> out(num_fields * some.num_rows());
  apply(some, in, out, num_fields, options);
  return out;
}

TEST(interpolation_weights, rows_are_sums_and_rows_without_entries_are_filled) {
  const auto out = applied({8, 4, 16, 100});
  EXPECT_EQ(out[0], 76);
  EXPECT_TRUE(std::isnan(out[1]));
  EXPECT_EQ(out[2], 9);
  EXPECT_EQ(applied({8, 4, 16, 100}, {.fill = -9}), std::vector<double>({76, -9, 9}));
}

// Weights 1/7 and the like sum up to 1 but for rounding, in rows of each length and in groups of fields.
TEST(interpolation_weights, constants_are_exact_and_means_within_their_values) {
  std::mt19937 random(5);
  Weights weights;
  weights.num_columns = 50;
  for (std::size_t r = 0; r < 500; ++r) {
    const std::size_t size = 1 + r % 40;
    std::vector<double> parts(size);
    double all = 0;
    const bool has_negative = r % 3 == 0 && size > 1;
    for (double& part : parts) part = std::uniform_real_distribution<double>(0, 1)(random);
    if (has_negative) parts.front() = -parts.front() / static_cast<double>(2 * size);
    for (const double part : parts) all += part;
    for (std::size_t k = 0; k < size; ++k) {
      weights.columns.push_back(static_cast<Index>((7 * r + k) % 50));
      weights.values.push_back(parts[k] / all);
    }
    weights.end_row();
  }
  for (const std::size_t num_fields : {1U, 4U, 13U}) {
    for (const double constant : {280.1, -0.1, 1e-300, 5e-324, 1e308, 0.0}) {
      std::vector<double> in(num_fields * 50, constant);
      std::vector<double> out(num_fields * 500);
      apply(weights, in, out, num_fields);
      for (const double value : out) EXPECT_EQ(value, constant);
      for (std::size_t k = 0; k < in.size(); k += 3) in[k] = std::nan("");
      apply(weights, in, out, num_fields, {.max_missing = 1});
      for (const double value : out) EXPECT_TRUE(std::isnan(value) || value == constant) << value;
    }
    // Values that differ in their last bits, of rows whose weights are not negative.
    std::vector<double> in;
    for (std::size_t k = 0; k < num_fields * 50; ++k)
      in.push_back(280.1 + (k % 3 == 0 ? 6e-14 : 0));
    std::vector<double> out(num_fields * 500);
    apply(weights, in, out, num_fields);
    const auto [low, high] = std::ranges::minmax(in);
    for (std::size_t r = 0; r < out.size(); ++r) {
      const bool has_negative = r % 500 % 3 == 0;
      EXPECT_TRUE(has_negative || (out[r] >= low && out[r] <= high)) << out[r] - low;
    }
  }
  // A row whose sum is not 1 is no mean.
  EXPECT_EQ(applied({3, 3, 3, 3})[0], 3);
  const Weights half = {
      .offsets = {0, 2}, .columns = {0, 1}, .values = {0.25, 0.25}, .num_columns = 2};
  std::vector<double> out(1);
  apply(half, std::vector<double>{3, 3}, out);
  EXPECT_EQ(out[0], 1.5);
}

TEST(interpolation_weights, choose_values_where_each_row_has_one_entry_that_is_1) {
  const auto choose = [](const std::vector<double>& values) {
    return choose_values(
        {.offsets = {0, 1, 1, 3}, .columns = {1, 0, 1}, .values = values, .num_columns = 2});
  };
  EXPECT_TRUE(choose({1, 0, 1}));
  EXPECT_TRUE(choose({1, 1, 0}));
  EXPECT_FALSE(choose({1, 1, 1}));
  EXPECT_FALSE(choose({1, 0.5, 0.5}));
  EXPECT_FALSE(choose({0.5, 0, 1}));
  EXPECT_FALSE(choose_values(some));
  EXPECT_TRUE(choose_values({}));
  EXPECT_THROW((void)choose_values({.offsets = {0, 2}, .columns = {0}, .values = {1}}),
               InvalidInput);
}

TEST(interpolation_weights, fields_lie_one_behind_the_other) {
  EXPECT_EQ(applied({8, 4, 16, 100, 0, 4, 8, 0}, {.fill = 0}, 2),
            std::vector<double>({76, 0, 9, 1, 0, 3}));
  EXPECT_TRUE(applied({}, {}, 0).empty());
}

TEST(interpolation_weights, missing_values_are_left_out_up_to_a_share) {
  const std::vector<double> in = {nan, 4, 16, nan};
  for (const double v : applied(in)) EXPECT_TRUE(std::isnan(v));
  // Row 0 misses 0.75 of 1, row 2 misses 0.5: the limit counts as allowed.
  EXPECT_EQ(applied(in, {.fill = -1, .max_missing = 0.49}), std::vector<double>({-1, -1, -1}));
  EXPECT_EQ(applied(in, {.fill = -1, .max_missing = 0.5}), std::vector<double>({-1, -1, 10}));
  EXPECT_EQ(applied(in, {.fill = -1, .max_missing = 1}), std::vector<double>({4, -1, 10}));
  EXPECT_EQ(applied({nan, nan, nan, nan}, {.fill = -1, .max_missing = 1}),
            std::vector<double>({-1, -1, -1}));
}

// Parts of a row in floating point are no exact shares, such as thirds.
TEST(interpolation_weights, parts_at_the_limit_may_be_missing) {
  for (const int parts : {2, 3, 7, 10, 49}) {
    Weights row;
    row.num_columns = static_cast<std::size_t>(parts);
    for (Index i = 0; i < row.num_columns; ++i) {
      row.columns.push_back(i);
      row.values.push_back(0.1 * (1.0 / parts));
    }
    row.end_row();
    std::vector<double> in(row.num_columns, 3.0);
    for (int missing = 0; missing < parts; ++missing) {
      const double share = static_cast<double>(missing) / parts;
      std::vector<double> out(1);
      apply(row, in, out, 1, {.max_missing = share});
      EXPECT_NEAR(out[0], 0.3, 1e-14) << missing << " of " << parts;
      apply_largest_share(row, in, out, 1, {.max_missing = share});
      EXPECT_EQ(out[0], 3) << missing << " of " << parts;
      EXPECT_EQ(covered_enough(std::vector{1 - share}, share), std::vector<std::int32_t>{1});
      if (missing > 0) {
        apply(row, in, out, 1, {.max_missing = share - 1e-8});
        EXPECT_TRUE(std::isnan(out[0])) << missing << " of " << parts;
        apply_largest_share(row, in, out, 1, {.max_missing = share - 1e-8});
        EXPECT_TRUE(std::isnan(out[0])) << missing << " of " << parts;
        EXPECT_EQ(covered_enough(std::vector{1 - share}, share - 1e-8),
                  std::vector<std::int32_t>{0});
      }
      in[static_cast<std::size_t>(missing)] = nan;
    }
  }
  EXPECT_EQ(covered_enough(std::vector{0.0, 1e-300, 1.0}, 1), std::vector<std::int32_t>({0, 1, 1}));
}

TEST(interpolation_weights, infinite_values_are_values) {
  const auto out = applied({infinity, -infinity, 0, infinity});
  EXPECT_TRUE(std::isnan(out[0]));  // their difference
  EXPECT_TRUE(std::isnan(out[2]));
  EXPECT_EQ(applied({infinity, 0, 0, 0})[2], infinity);
}

TEST(interpolation_weights, that_are_not_finite_are_refused) {
  for (const double bad : {infinity, -infinity, nan}) {
    const Weights weights = {
        .offsets = {0, 2, 3}, .columns = {0, 1, 1}, .values = {0.5, 0.5, bad}, .num_columns = 2};
    std::vector<double> out(4);
    for (const std::size_t num_fields : {0U, 1U, 2U}) {
      const std::vector<double> in(2 * num_fields, 0.0);
      try {
        apply(weights, in, std::span(out).first(2 * num_fields), num_fields);
        FAIL() << bad;
      } catch (const InvalidInput& error) {
        EXPECT_EQ(error.index(), 2U);
        EXPECT_EQ(std::string(error.what()).substr(0, 12), "weight 2 is ");
      }
    }
  }
}

TEST(interpolation_weights, sums_beyond_the_largest_number_come_back) {
  const Weights steep = {
      .offsets = {0, 3}, .columns = {0, 1, 2}, .values = {3, -2.5, 0.5}, .num_columns = 3};
  std::vector<double> out(1);
  const auto sum_of = [&](const std::vector<double>& in, const ApplyOptions& options = {}) {
    apply(steep, in, out, 1, options);
    return out[0];
  };
  EXPECT_EQ(sum_of({0x1p1023, 0x1p1023, 0x1p1023}), 0x1p1023);
  EXPECT_EQ(sum_of({-0x1p1023, -0x1p1023, 0}), -0x1p1022);
  EXPECT_EQ(sum_of({0x1p1023, 0x1p1023, nan}, {.max_missing = 0.5}), 0x1p1023);
  EXPECT_EQ(sum_of({0x1p1023, 0, 0}), std::numeric_limits<double>::infinity());
}

TEST(interpolation_weights, threads_change_no_byte) {
  Random random(3);
  Weights weights;
  weights.num_columns = 1000;
  for (int r = 0; r < 30000; ++r) {
    for (std::size_t k = random.below(6); k > 0; --k) {
      weights.columns.push_back(static_cast<Index>(random.below(1000)));
      weights.values.push_back(random.signed_unit());
    }
    weights.offsets.push_back(weights.columns.size());
  }
  std::vector<double> in(2000);
  for (double& value : in) value = random.signed_unit();
  std::vector<double> one(2 * weights.num_rows());
  std::vector<double> four(one.size());
  apply(weights, in, one, 2, {.fill = 0}, {.threads = 1});
  apply(weights, in, four, 2, {.fill = 0}, {.threads = 4});
  EXPECT_EQ(one, four);
  double sum = 0;
  for (std::uint64_t k = weights.offsets[77]; k < weights.offsets[78]; ++k) {
    sum += weights.values[k] * in[1000 + weights.columns[k]];
  }
  EXPECT_EQ(one[30077], sum);
}

void expect_refused(std::size_t index, const std::string& message, const Weights& weights,
                    std::size_t in, std::size_t out, std::size_t num_fields = 1,
                    const ApplyOptions& options = {}) {
  std::vector<double> results(out);
  try {
    apply(weights, std::vector<double>(in), results, num_fields, options);
    ADD_FAILURE() << "not refused: " << message;
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), index);
    EXPECT_EQ(std::string(error.what()), message);
  }
}

TEST(interpolation_weights, what_is_not_in_compressed_rows_is_refused) {
  Weights bad = some;
  bad.values.pop_back();
  expect_refused(InvalidInput::no_index, "values has 4 numbers instead of 5", bad, 4, 3);
  bad = some;
  bad.offsets = {};
  expect_refused(InvalidInput::no_index, "the offsets do not go from 0 to 5", bad, 4, 3);
  bad.offsets = {1, 2, 2, 5};
  expect_refused(InvalidInput::no_index, "the offsets do not go from 0 to 5", bad, 4, 3);
  bad.offsets = {0, 2, 2, 4};
  expect_refused(InvalidInput::no_index, "the offsets do not go from 0 to 5", bad, 4, 3);
  bad.offsets = {0, 3, 2, 5};
  expect_refused(2, "the offsets decrease", bad, 4, 3);
  bad = some;
  bad.columns[3] = 4;
  expect_refused(3, "column 4 of 4", bad, 4, 3);
}

TEST(interpolation_weights, arrays_of_other_lengths_are_refused) {
  expect_refused(InvalidInput::no_index, "the input has 5 numbers instead of 4", some, 5, 3);
  expect_refused(InvalidInput::no_index, "the output has 4 numbers instead of 3", some, 4, 4);
  expect_refused(InvalidInput::no_index, "the input has 4 numbers instead of 8", some, 4, 6, 2);
  expect_refused(InvalidInput::no_index, "max_missing is 1.5, not in [0, 1]", some, 4, 3, 1,
                 {.max_missing = 1.5});
  expect_refused(InvalidInput::no_index, "max_missing is nan, not in [0, 1]", some, 4, 3, 1,
                 {.max_missing = nan});
  // So many fields that their number times 4 is 0 again.
  constexpr std::size_t wraps = std::numeric_limits<std::size_t>::max() / 4 + 1;
  expect_refused(InvalidInput::no_index,
                 std::to_string(wraps) + " fields of 4 numbers are more than an array can hold",
                 some, 0, 0, wraps);
}

TEST(interpolation_weights, hashes_depend_on_points_and_their_order) {
  const std::vector<Point> points = {{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(point_set_hash({}), 0xcbf29ce484222325U);
  EXPECT_NE(point_set_hash(points), point_set_hash(std::vector<Point>{{4, 5, 6}, {1, 2, 3}}));
  EXPECT_NE(point_set_hash(points), point_set_hash(std::vector<Point>{{1, 2, 3}}));
  EXPECT_EQ(point_set_hash(std::vector<Point>{{0.0, 1, 0}}),
            point_set_hash(std::vector<Point>{{-0.0, 1, -0.0}}));
  // FNV-1a of the 24 bytes, one at a time.
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add_zeros = [&hash](int n) {
    for (; n > 0; --n) hash *= 0x100000001b3U;
  };
  add_zeros(6);
  for (const std::uint64_t byte : {0xf0U, 0x3fU}) hash = (hash ^ byte) * 0x100000001b3U;
  add_zeros(16);
  EXPECT_EQ(point_set_hash(std::vector<Point>{{1, 0, 0}}), hash);
}

}  // namespace
}  // namespace rondel::test
