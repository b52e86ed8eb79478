// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CollectedRows: rows of weights that come in any order, put together in the order of the targets.
//
//     list 1: target 2, target 0        row 0   row 1 (empty)   row 2   row 3
//     list 2: target 3                  A column is a site, or with SharedPlace::mean each of the sites in one place.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "interpolation/collected_rows.h"
#include "rondel/delaunay.h"

namespace rondel::test::of_collected_rows {
namespace {

using interpolation::CollectedRows;
using interpolation::PreparedTriangulation;
using interpolation::RowList;

// An octahedron; sites 1, 4 and 7 are in one place.
const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1},  {-1, 0, 0},
                                  {0, 2, 0}, {0, -1, 0}, {0, 0, -1}, {0, 1, 0}};

// Appends the row of a target, with these weights of sites.
void append(const PreparedTriangulation& prepared, const CollectedRows& rows, Index target,
            const std::vector<std::pair<Index, double>>& weights, RowList& list) {
  interpolation::Row row;
  for (const auto& [site, weight] : weights) row.push_back({prepared.vertex_of(site), weight});
  rows.append(target, row, list);
}

TEST(collected_rows, are_in_the_order_of_targets) {
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  for (const bool is_second_first : {false, true}) {
    CollectedRows rows(prepared, SharedPlace::first);
    RowList one;
    append(prepared, rows, 2, {{0, 0.25}, {5, 0.75}}, one);
    append(prepared, rows, 0, {{3, 1}}, one);
    RowList two;
    append(prepared, rows, 3, {{1, 0.5}, {2, 0.125}, {6, 0.375}}, two);
    rows.add(is_second_first ? two : one);
    rows.add(is_second_first ? one : two);
    const Weights weights = rows.joined(5, 2);
    EXPECT_EQ(weights.offsets, (std::vector<std::uint64_t>{0, 1, 1, 3, 6, 6}));
    EXPECT_EQ(weights.columns, (std::vector<Index>{3, 0, 5, 1, 2, 6}));
    EXPECT_EQ(weights.values, (std::vector<double>{1, 0.25, 0.75, 0.5, 0.125, 0.375}));
    EXPECT_EQ(weights.num_columns, 8U);
  }
}

TEST(collected_rows, have_equal_parts_for_sites_in_one_place) {
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  CollectedRows rows(prepared, SharedPlace::mean);
  RowList list;
  append(prepared, rows, 0, {{0, 0.25}, {1, 0.75}}, list);
  append(prepared, rows, 1, {{1, 1.5}, {2, -0.5}}, list);
  rows.add(list);
  const Weights weights = rows.joined(2, 1);
  EXPECT_EQ(weights.offsets, (std::vector<std::uint64_t>{0, 4, 8}));
  EXPECT_EQ(weights.columns, (std::vector<Index>{0, 1, 4, 7, 1, 4, 7, 2}));
  EXPECT_EQ(weights.values, (std::vector<double>{0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, -0.5}));
}

TEST(collected_rows, of_nobody_are_empty) {
  const Triangulation triangulation = delaunay(sites);
  const PreparedTriangulation prepared(triangulation);
  CollectedRows rows(prepared, SharedPlace::first);
  rows.add({});
  EXPECT_EQ(rows.joined(2, 1).offsets, (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_EQ(rows.joined(0, 1).num_rows(), 0U);
}

}  // namespace
}  // namespace rondel::test::of_collected_rows
