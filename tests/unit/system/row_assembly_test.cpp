// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compressed rows, as results have them and as they are assembled.
#include "system/row_assembly.h"

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "gtest/gtest.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::system {
namespace {

using Offsets = std::vector<std::uint64_t>;

// Rows of a block, with the number that each has in the result.
struct NamedBlock {
  std::vector<Index> names;
  std::vector<Index> sizes;
  std::vector<Index> columns;
  std::vector<double> values;
};

TEST(compressed_rows, are_appended) {
  CompressedRows<int> rows;
  EXPECT_EQ(rows.size(), 0U);
  rows.append(std::vector<int>{4, 5});
  rows.end_row();
  rows.values.push_back(6);
  rows.end_row();
  EXPECT_EQ(rows.offsets, (Offsets{0, 2, 2, 3}));
  EXPECT_EQ(rows[0].back(), 5);
  EXPECT_TRUE(rows[1].empty());
  CompressedRows<int> twice = rows;
  twice.append_rows(rows);
  EXPECT_EQ(twice.offsets, (Offsets{0, 2, 2, 3, 5, 5, 6}));
  EXPECT_EQ(twice.values, (std::vector<int>{4, 5, 6, 4, 5, 6}));
  twice.append_rows({});
  EXPECT_EQ(twice.size(), 6U);
}

TEST(compressed_rows, form_groups) {
  RowGroups<CompressedRows<int>> groups;
  groups.end_group();
  groups.rows.append(std::vector<int>{1});
  groups.rows.append({});
  groups.end_group();
  EXPECT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups.offsets, (Offsets{0, 0, 2}));
}

TEST(row_assembly, knows_what_offsets_are) {
  EXPECT_TRUE(are_offsets(Offsets{0}, 0));
  EXPECT_TRUE(are_offsets(Offsets{0, 0, 3, 3}, 3, 3));
  EXPECT_FALSE(are_offsets(Offsets{}, 0));
  EXPECT_FALSE(are_offsets(Offsets{1, 3}, 3));
  EXPECT_FALSE(are_offsets(Offsets{0, 2}, 3));
  EXPECT_FALSE(are_offsets(Offsets{0, 3, 2, 3}, 3));
  EXPECT_FALSE(are_offsets(Offsets{0, 3}, 2, 3));
}

TEST(row_assembly, sums_counts) {
  Offsets counts = {0, 2, 0, 3};
  sum_counts(counts);
  EXPECT_EQ(counts, (Offsets{0, 2, 2, 5}));
  EXPECT_EQ(offsets_of(3, [](std::size_t i) { return i; }), (Offsets{0, 0, 1, 3}));
  EXPECT_EQ(offsets_of(0, [](std::size_t) { return 1U; }), Offsets{0});
}

TEST(row_assembly, keeps_the_order_of_entries_in_a_row) {
  const std::vector<std::size_t> rows = {3, 0, 3, 1, 0, 3};
  RowPlaces places(5);
  for (const std::size_t row : rows) places.count(row);
  std::vector<std::size_t> entries(places.sum());
  for (std::size_t k = 0; k < rows.size(); ++k) entries[places.place(rows[k])] = k;
  EXPECT_EQ(entries, (std::vector<std::size_t>{1, 4, 3, 0, 2, 5}));
  EXPECT_EQ(std::move(places).offsets(), (Offsets{0, 2, 3, 3, 6, 6}));
  RowPlaces none(0);
  EXPECT_EQ(none.sum(), 0U);
  EXPECT_EQ(std::move(none).offsets(), Offsets{0});
}

TEST(row_assembly, joins_blocks_for_any_number_of_threads) {
  constexpr std::size_t num_rows = 10000;
  constexpr std::size_t rows_in_block = 7;
  const auto size_of = [](std::size_t row) { return row % 11 == 0 ? 0 : row * row % 5; };
  const auto name_of = [](std::size_t k) { return k * 7919 % num_rows; };  // a permutation
  std::vector<NamedBlock> blocks(num_pieces(num_rows - 20, rows_in_block));
  for (std::size_t k = 0; k + 20 < num_rows; ++k) {  // twenty rows are in no block
    NamedBlock& block = blocks[k / rows_in_block];
    const std::size_t row = name_of(k);
    block.names.push_back(static_cast<Index>(row));
    block.sizes.push_back(static_cast<Index>(size_of(row)));
    for (std::size_t j = 0; j < size_of(row); ++j) {
      block.columns.push_back(static_cast<Index>(10 * row + j));
    }
  }
  Offsets expected(num_rows + 1, 0);
  for (std::size_t k = 0; k + 20 < num_rows; ++k) expected[name_of(k) + 1] = size_of(name_of(k));
  std::partial_sum(expected.begin(), expected.end(), expected.begin());
  for (const unsigned threads : {1U, 2U, 3U, 16U}) {
    CompressedRows<Index> rows;
    std::vector<double> unused;
    rows.offsets = join_rows(
        threads, num_rows, blocks,
        [](std::size_t, const NamedBlock& block, std::size_t k) { return block.names[k]; },
        JoinedColumn{&NamedBlock::columns, rows.values}, JoinedColumn{&NamedBlock::values, unused});
    ASSERT_EQ(rows.offsets, expected) << threads;
    for (std::size_t row = 0; row < num_rows; ++row) {
      for (std::size_t j = 0; j < rows[row].size(); ++j) ASSERT_EQ(rows[row][j], 10 * row + j);
    }
    EXPECT_TRUE(unused.empty());
  }
}

TEST(row_assembly, joins_no_blocks_to_empty_rows) {
  std::vector<Index> columns;
  const Offsets offsets = join_rows(
      2, 3, std::vector<NamedBlock>(),
      [](std::size_t, const NamedBlock&, std::size_t k) { return k; },
      JoinedColumn{&NamedBlock::columns, columns});
  EXPECT_EQ(offsets, (Offsets{0, 0, 0, 0}));
  EXPECT_TRUE(columns.empty());
}

}  // namespace
}  // namespace rondel::system
