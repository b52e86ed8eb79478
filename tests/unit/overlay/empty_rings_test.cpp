// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings without corners, which arrays from elsewhere may have, add nothing to their cells.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "rondel/buffer.h"
#include "rondel/error.h"
#include "rondel/feature_cells.h"
#include "rondel/polygon_triangles.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
#include "rondel/set_operations.h"
#include "rondel/simplify.h"

namespace rondel::test {
namespace {

// An octant; its opposite, a cell that is empty, and the sphere. With empty rings there is one
// before each ring and in each cell without rings but the sphere.
CellRings some_cells(bool with_empty_rings) {
  CellRings cells;
  cells.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const std::array<Index, 3>& corners : {std::array<Index, 3>{0, 1, 2}, {3, 5, 4}}) {
    if (with_empty_rings) cells.end_ring();
    cells.append_ring(corners);
    cells.end_cell();
  }
  if (with_empty_rings) cells.end_ring();
  cells.end_cell();
  cells.whole = {3};
  cells.end_cell();
  return cells;
}

class EmptyRings : public testing::Test {
 protected:
  CellRings plain_ = some_cells(false);
  CellRings cells_ = some_cells(true);
};

void expect_same(const CellRings& found, const CellRings& expected) {
  EXPECT_EQ(found.cells, expected.cells);
  EXPECT_EQ(found.rings, expected.rings);
  EXPECT_EQ(found.corners, expected.corners);
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.whole, expected.whole);
}

TEST_F(EmptyRings, have_no_size) {
  EXPECT_EQ(areas(cells_), areas(plain_));
  EXPECT_EQ(areas(cells_)[2], 0);
  EXPECT_EQ(lengths(cells_), lengths(plain_));
}

TEST_F(EmptyRings, are_not_drawn) {
  for (const CellDrawing drawing : {CellDrawing::together, CellDrawing::apart}) {
    const LonLatRegions drawn = region_polygons(cells_, 0.01, {}, drawing);
    const LonLatRegions expected = region_polygons(plain_, 0.01, {}, drawing);
    EXPECT_EQ(drawn.owners, expected.owners);
    EXPECT_EQ(drawn.polygons.offsets, expected.polygons.offsets);
    EXPECT_EQ(drawn.polygons.rows.values, expected.polygons.rows.values);
  }
  EXPECT_EQ(crossing_cells(cells_).size(), crossing_cells(plain_).size());
}

TEST_F(EmptyRings, are_no_parts_of_regions) {
  const std::vector<Index> groups = {0, 0, 1, 2};
  expect_same(dissolve(cells_, groups, 3), dissolve(plain_, groups, 3));
  expect_same(unite(cells_), unite(plain_));
  expect_same(repaired(cells_), repaired(plain_));
  expect_same(buffered(cells_, {0.1, 0.01}), buffered(plain_, {0.1, 0.01}));
  expect_same(buffered(cells_, {-0.1, 0.01}), buffered(plain_, {-0.1, 0.01}));
  std::vector<std::array<Index, 2>> pairs;
  for (Index i = 0; i < 4; ++i) {
    for (Index k = 0; k < 4; ++k) pairs.push_back({i, k});
  }
  for (const SetOperation operation :
       {SetOperation::unite, SetOperation::intersection, SetOperation::difference,
        SetOperation::symmetric_difference, SetOperation::identity}) {
    expect_same(combine(cells_, plain_, operation), combine(plain_, plain_, operation));
    expect_same(overlay_pieces(cells_, plain_, operation).rings,
                overlay_pieces(plain_, plain_, operation).rings);
    expect_same(combine_pairs(cells_, cells_, pairs, operation),
                combine_pairs(plain_, plain_, pairs, operation));
  }
  EXPECT_EQ(relate_pairs(cells_, cells_, pairs), relate_pairs(plain_, plain_, pairs));
  EXPECT_EQ(related_pairs(cells_, cells_), related_pairs(plain_, plain_));
}

TEST_F(EmptyRings, change_no_simplification_and_no_triangles) {
  const CellRings simple = simplified(cells_, {.tolerance = 0.01});
  EXPECT_EQ(areas(simple), areas(plain_));
  const PolygonTriangles triangles = triangles_of_polygons(cells_, 20);
  const PolygonTriangles expected = triangles_of_polygons(plain_, 20);
  EXPECT_EQ(triangles.points, expected.points);
  EXPECT_EQ(triangles.triangles.offsets, expected.triangles.offsets);
  EXPECT_EQ(triangles.triangles.values, expected.triangles.values);
}

TEST_F(EmptyRings, are_refused_where_cells_are_to_be_valid) {
  EXPECT_THROW(CellSet::polygons(cells_), InvalidInput);
  EXPECT_THROW(overlapping_cells(cells_), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
