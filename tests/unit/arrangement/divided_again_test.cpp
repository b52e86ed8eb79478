// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons that are divided by the cells of a quadtree, the results by the cells of the next level,
// and so on: chains in which sides of the operands lie on sides of former results. Reports 474 and
// 475 of s2geometry are about such chains, whose results became invalid there, or crashed the next
// operation. Here all parts stay valid, and together they are the polygon.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/regions.h"
#include "rondel/set_operations.h"
#include "support/random.h"

namespace rondel::test::of_divided {
namespace {

CellRings polygon_of(const std::vector<Point>& ring) {
  CellRings polygon;
  polygon.points = ring;
  for (Index k = 0; k < ring.size(); ++k) polygon.corners.push_back(k);
  polygon.end_ring();
  polygon.end_cell();
  return polygon;
}

// A cell of the faces of a cube, whose sides are halved in a quadratic measure, as S2's are.
struct CubeCell {
  int face;
  int level;
  std::array<int, 2> at;  // in units of the cells of this level

  [[nodiscard]] CellRings polygon() const {
    const auto coordinate = [&](int k) {
      const double s = std::ldexp(k, -level);
      return s >= 0.5 ? (4 * s * s - 1) / 3 : (1 - 4 * (1 - s) * (1 - s)) / 3;
    };
    std::vector<Point> ring;
    for (const auto& [i, k] : std::array<std::array<int, 2>, 4>{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}) {
      const double u = coordinate(at[0] + i);
      const double v = coordinate(at[1] + k);
      ring.push_back(
          normalized(std::array<Point, 6>{{{1, u, v},
                                           {-u, 1, v},
                                           {-u, -v, 1},
                                           {-1, -v, -u},
                                           {v, -1, -u},
                                           {v, u, -1}}}[static_cast<std::size_t>(face)]));
    }
    return polygon_of(ring);
  }
};

bool is_empty(const CellRings& polygon) {
  return polygon.rings.size() == 1 && polygon.whole.empty();
}

double area_of(const CellRings& polygon) {
  return polygon.whole.empty() ? areas(polygon)[0] : 4 * std::numbers::pi;
}

// Divides a polygon by a cell and what is left by the cells below it, and appends the parts of the
// last level.
void divide(const CellRings& polygon, const CubeCell& cell, int last, CellRings& parts) {
  const CellRings part = combine(polygon, cell.polygon(), SetOperation::intersection);
  ASSERT_TRUE(crossing_cells(part).empty()) << cell.level;
  if (is_empty(part)) return;
  if (cell.level == last) {
    const auto first = static_cast<Index>(parts.points.size());
    parts.points.insert(parts.points.end(), part.points.begin(), part.points.end());
    for (std::size_t r = 0; r + 1 < part.rings.size(); ++r) {
      for (const Index corner : part.corners_of(r)) parts.corners.push_back(first + corner);
      parts.end_ring();
    }
    parts.end_cell();
    return;
  }
  for (int k = 0; k < 4; ++k) {
    divide(part, {cell.face, cell.level + 1, {2 * cell.at[0] + k % 2, 2 * cell.at[1] + k / 2}},
           last, parts);
  }
}

// A ring around a place, with corners at any distances below `size`.
std::vector<Point> star(const Point& middle, double size, int num_corners, Random& random) {
  const Point u =
      normalized(cross(middle, std::abs(middle.z) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0}));
  const Point v = cross(middle, u);
  std::vector<Point> ring;
  for (int k = 0; k < num_corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / num_corners;
    const double r = size * (0.2 + 0.8 * random.unit());
    ring.push_back(normalized(middle + r * std::cos(angle) * u + r * std::sin(angle) * v));
  }
  return ring;
}

class DividedAgain : public testing::TestWithParam<int> {};

TEST_P(DividedAgain, polygons_stay_valid_and_whole) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  const Point corner = normalized({1, 1, 1});  // of the cube, where three faces meet
  const Point middle =
      GetParam() % 2 == 0
          ? corner
          : normalized({random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
  const double size = std::array{1.5, 0.4, 0.05}[static_cast<std::size_t>(GetParam() % 3)];
  const CellRings polygon = polygon_of(star(middle, size, 5 + 7 * (GetParam() % 5), random));
  CellRings parts;
  for (int face = 0; face < 6; ++face) divide(polygon, {face, 0, {0, 0}}, 5, parts);
  double sum = 0;
  for (const double area : areas(parts)) sum += area;
  EXPECT_NEAR(sum, area_of(polygon), 1e-13);
  EXPECT_TRUE(overlapping_cells(parts).empty());
  const CellRings again = unite(parts);
  EXPECT_NEAR(area_of(combine(again, polygon, SetOperation::symmetric_difference)), 0, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(all, DividedAgain, testing::Range(0, 12));

}  // namespace
}  // namespace rondel::test::of_divided
