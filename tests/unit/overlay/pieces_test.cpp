// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// pieces(): what octants have in common with octants that are turned by 45 degrees around the poles.
//
//        0         90        180       270       360
//        +---------+---------+---------+---------+
//        |    :    |    :    |    :    |    :    |       Each octant consists of two halves with an area of pi / 4, in
//        |    :    |    :    |    :    |    :    |       two of the turned octants (dotted).
//        +---------+---------+---------+---------+
#include "overlay/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "exact/vector.h"
#include "overlay/measure.h"
#include "overlay/subdivision.h"
#include "rondel/error.h"
#include "unit/overlay/support.h"

namespace rondel::test::of_pieces {
namespace {

using overlay::PieceRows;
using overlay::Subdivision;
constexpr double pi = std::numbers::pi;

// The northern octants 0 to 3 from some longitude on to the east, and the southern octants 4 to 7.
CellRings turned_octants(double first_lon_deg, std::size_t number = 8) {
  CellRings result;
  for (int k = 0; k < 4; ++k) {
    const double lon = (first_lon_deg + 90 * k) * pi / 180;
    result.points.push_back({std::cos(lon), std::sin(lon), 0});
  }
  result.points.push_back({0, 0, 1});
  result.points.push_back({0, 0, -1});
  for (Index k = 0; k < number; ++k) {
    const Index here = k % 4;
    const Index east = (k + 1) % 4;
    if (k < 4) result.corners.insert(result.corners.end(), {here, east, 4});
    if (k >= 4) result.corners.insert(result.corners.end(), {east, here, 5});
    result.rings.push_back(result.corners.size());
    result.cells.push_back(result.rings.size() - 1);
  }
  return result;
}

const std::vector<double> octant_areas(8, pi / 2);
const std::vector<double> octant_lengths(8, 3 * pi / 2);
const overlay::CellSizes octant_sizes{octant_areas, octant_lengths};

TEST(overlay_pieces, of_octants_are_halves) {
  const Subdivision octants(turned_octants(0), false, 1);
  const Subdivision turned(turned_octants(45), false, 1);
  for (const bool has_moments : {false, true}) {
    PieceRows found = overlay::pieces(octants, octant_sizes, turned, has_moments, {});
    ASSERT_EQ(found.offsets.size(), 9U);
    ASSERT_EQ(found.columns.size(), 16U);
    EXPECT_EQ(found.moments.size(), has_moments ? 16U : 0U);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(found.offsets[i], 2 * i);
      // Turned octant k begins in the middle of octant k, so that octant k ends in it.
      const std::size_t before = i / 4 * 4 + (i + 3) % 4;
      EXPECT_EQ(found.columns[2 * i], std::min(i, before));
      EXPECT_EQ(found.columns[2 * i + 1], std::max(i, before));
      EXPECT_NEAR(found.areas[2 * i], pi / 4, 1e-15);
      EXPECT_NEAR(found.areas[2 * i + 1], pi / 4, 1e-15);
      if (!has_moments) continue;
      // The integral of each coordinate over an octant is pi / 4, and that of z over each half of it is pi / 8.
      const Point sum = found.moments[2 * i] + found.moments[2 * i + 1];
      EXPECT_NEAR(sum.x, i % 4 == 0 || i % 4 == 3 ? pi / 4 : -pi / 4, 1e-14);
      EXPECT_NEAR(sum.y, i % 4 < 2 ? pi / 4 : -pi / 4, 1e-14);
      EXPECT_NEAR(found.moments[2 * i].z, i < 4 ? pi / 8 : -pi / 8, 1e-14);
    }
    overlay::find_sums(found, 8);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(found.row_sums[i], pi / 2, 2e-15);
      EXPECT_NEAR(found.column_sums[i], pi / 2, 2e-15);
    }
  }
}

// Cells that are equal but for rounding have themselves as their only pieces.
TEST(overlay_pieces, narrower_than_rounding_are_dropped) {
  const Subdivision octants(turned_octants(0), false, 1);
  for (const double turn : {0.0, 1e-15, -1e-14}) {
    const Subdivision others(turned_octants(turn), false, 1);
    const PieceRows found = overlay::pieces(octants, octant_sizes, others, false, {});
    ASSERT_EQ(found.columns.size(), 8U) << turn;
    for (Index i = 0; i < 8; ++i) {
      EXPECT_EQ(found.columns[i], i);
      EXPECT_NEAR(found.areas[i], pi / 2, 1e-14);
    }
  }
  const Subdivision others(turned_octants(1e-6), false, 1);
  EXPECT_EQ(overlay::pieces(octants, octant_sizes, others, false, {}).columns.size(), 16U);
}

// A cell that is not as large as its pieces together is refused.
TEST(overlay_pieces, add_up_to_their_cell) {
  const Subdivision octants(turned_octants(0), false, 1);
  const Subdivision turned(turned_octants(45), false, 1);
  std::vector<double> areas = octant_areas;
  areas[5] *= 1 + 1e-7;
  EXPECT_THROW(
      {
        overlay::pieces(octants, overlay::CellSizes{areas, octant_lengths}, turned, false, {});
      },
      InvalidInput);
}

// Only the turned octants of the north, and the whole of it all, with the two that overlap.
TEST(overlay_pieces, of_parts_need_no_cover) {
  const Subdivision octants(turned_octants(0), false, 1);
  const Subdivision north(turned_octants(45, 4), false, 1);
  const PieceRows found = overlay::pieces_of_parts(octants, octant_sizes, north, true, {});
  ASSERT_EQ(found.columns.size(), 8U);
  for (std::size_t i = 0; i <= 8; ++i) EXPECT_EQ(found.offsets[i], std::min<std::size_t>(2 * i, 8));
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(found.areas[k], pi / 4, 1e-14);
    EXPECT_NEAR(found.moments[k].z, pi / 8, 1e-14);
  }
  const Subdivision one(turned_octants(45, 1), false, 1);
  const PieceRows few = overlay::pieces_of_parts(octants, octant_sizes, one, false, {});
  EXPECT_EQ(few.columns, (std::vector<Index>{0, 0}));
  EXPECT_EQ(few.offsets, (std::vector<std::uint64_t>{0, 1, 2, 2, 2, 2, 2, 2, 2}));
}

TEST(overlay_pieces, of_parts_that_overlap_are_refused) {
  const Subdivision octants(turned_octants(0), false, 1);
  CellRings both = turned_octants(45, 1);
  const CellRings other = turned_octants(60, 1);
  const auto first = static_cast<Index>(both.points.size());
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  for (const Index corner : other.corners) both.corners.push_back(first + corner);
  both.rings.push_back(both.corners.size());
  both.cells.push_back(both.rings.size() - 1);
  const Subdivision overlapping(both, false, 1);
  EXPECT_THROW(overlay::pieces_of_parts(octants, octant_sizes, overlapping, false, {}),
               InvalidInput);
}

// The sides of a cube in four by four cells each, turned by some axes.
CellRings cube_cells(const Point& a, const Point& b, const Point& c) {
  CellRings cells;
  const auto add = [&](const Point& p) {
    const auto at = std::ranges::find(cells.points, p);
    cells.corners.push_back(static_cast<Index>(at - cells.points.begin()));
    if (at == cells.points.end()) cells.points.push_back(p);
  };
  for (const std::array<Point, 3>& axes : {std::array{a, b, c}, {b, c, a}, {c, a, b}}) {
    for (const double side : {1.0, -1.0}) {
      // Lines are at the tangents of equal angles, or their negatives, so that neighbors have equal corners.
      constexpr std::array<double, 5> lines{-1, -0.4, 0, 0.4, 1};
      const auto corner = [&](std::size_t i, std::size_t k) {
        const Point p = side * axes[0] + lines[i] * axes[1] + lines[k] * axes[2];
        const Point rounded = normalized(p);
        const double steps = 0x1p40;
        return normalized(Point{std::round(rounded.x * steps) / steps,
                                std::round(rounded.y * steps) / steps,
                                std::round(rounded.z * steps) / steps});
      };
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
          std::array<Point, 4> ring = {corner(i, k), corner(i + 1, k), corner(i + 1, k + 1),
                                       corner(i, k + 1)};
          if (side < 0) std::ranges::reverse(ring);
          std::ranges::for_each(ring, add);
          cells.rings.push_back(cells.corners.size());
          cells.cells.push_back(cells.rings.size() - 1);
        }
      }
    }
  }
  return cells;
}

LongRing ring_of_cell(const CellRings& cells, std::size_t i) {
  LongRing ring;
  for (std::uint64_t k = cells.rings[i]; k < cells.rings[i + 1]; ++k)
    ring.push_back(long_vector(cells.points[cells.corners[k]]));
  return ring;
}

// Small cells, whose pieces are found in the other way, by clipping one cell by the other.
TEST(overlay_pieces, of_cells_on_a_cube) {
  const CellRings given = cube_cells({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const Point a = normalized(Point{0.8, 0.5, -0.3});
  const Point b = normalized(cross(a, Point{0.1, 0.2, 1}));
  const CellRings turned = cube_cells(a, b, cross(a, b));
  const Subdivision cells(given, false, 1);
  const Subdivision cover(turned, false, 1);
  ASSERT_TRUE(cells.is_closed);
  ASSERT_TRUE(cover.is_closed);
  std::vector<double> areas;
  std::vector<Point> moments;
  for (std::size_t i = 0; i < 96; ++i) {
    areas.push_back(static_cast<double>(area_of(ring_of_cell(given, i))));
    Point moment{};
    for (std::uint64_t k = given.rings[i]; k < given.rings[i + 1]; ++k) {
      const std::uint64_t next = k + 1 < given.rings[i + 1] ? k + 1 : given.rings[i];
      moment = moment + overlay::moment_of_arc(given.points[given.corners[k]],
                                               given.points[given.corners[next]]);
    }
    moments.push_back(moment);
  }
  const std::vector<double> lengths(96, 2);
  const PieceRows found = overlay::pieces(cells, {areas, lengths}, cover, true, {});
  for (std::size_t i = 0; i < 96; ++i) {
    Point moment{};
    std::uint64_t k = found.offsets[i];
    for (Index j = 0; j < 96; ++j) {
      LongRing ring = ring_of_cell(given, i);
      const LongRing other = ring_of_cell(turned, j);
      for (std::size_t side = 0; side < 4; ++side)
        ring = clipped(ring, other[side], other[(side + 1) % 4]);
      const bool has_piece = k < found.offsets[i + 1] && found.columns[k] == j;
      EXPECT_NEAR(has_piece ? found.areas[k] : 0, static_cast<double>(area_of(ring)), 1e-14)
          << i << ' ' << j;
      if (!has_piece) continue;
      moment = moment + found.moments[k];
      ++k;
    }
    EXPECT_EQ(k, found.offsets[i + 1]);
    EXPECT_LT(norm(moment - moments[i]), 1e-14) << i;
  }
}

// Three rows and four columns:   . 1 . 2      Columns become rows, with ascending columns.
//                                3 . . .
//                                4 5 . .
TEST(overlay_pieces, transposed_have_columns_as_rows) {
  PieceRows rows;
  rows.offsets = {0, 2, 3, 5};
  rows.columns = {1, 3, 0, 0, 1};
  rows.areas = {1, 2, 3, 4, 5};
  for (const double area : rows.areas) rows.moments.push_back({area, -area, 2 * area});
  overlay::find_sums(rows, 4);
  EXPECT_EQ(rows.row_sums, (std::vector<double>{3, 3, 9}));
  EXPECT_EQ(rows.column_sums, (std::vector<double>{7, 6, 0, 2}));
  const PieceRows columns = overlay::transposed(rows, 4);
  EXPECT_EQ(columns.offsets, (std::vector<std::uint64_t>{0, 2, 4, 4, 5}));
  EXPECT_EQ(columns.columns, (std::vector<Index>{1, 2, 0, 2, 0}));
  EXPECT_EQ(columns.areas, (std::vector<double>{3, 4, 1, 5, 2}));
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(columns.moments[k],
              (Point{columns.areas[k], -columns.areas[k], 2 * columns.areas[k]}));
  EXPECT_EQ(columns.row_sums, rows.column_sums);
  EXPECT_EQ(columns.column_sums, rows.row_sums);
  const PieceRows back = overlay::transposed(columns, 3);
  EXPECT_EQ(back.columns, rows.columns);
  EXPECT_EQ(back.areas, rows.areas);
}

// Small areas are not lost in the sum with large ones, whatever their order.
TEST(overlay_pieces, sums_are_in_twice_the_precision) {
  PieceRows rows;
  rows.columns.assign(10'001, 0);
  rows.areas.assign(10'001, 1e-17);
  rows.areas[0] = 1;
  rows.offsets = {0, 10'001};
  overlay::find_sums(rows, 1);
  EXPECT_NEAR(rows.row_sums[0] - 1, 1e-13, 2e-16);
  EXPECT_NEAR(rows.column_sums[0] - 1, 1e-13, 2e-16);
}

}  // namespace
}  // namespace rondel::test::of_pieces
