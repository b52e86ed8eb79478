// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CoverTriangulation: triangles of the whole sphere, some of which are parts of given cells. Squares around (1, 0, 0) are the cells, with
// corners in tenths of the radius to the east and to the north.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "overlay/cover_triangulation.h"

namespace rondel::test::of_filling {
namespace {

using overlay::CoverTriangulation;
using overlay::SideConflict;
using overlay::Subdivision;
using Ring = std::vector<Point>;

Point near_x(double east, double north) { return normalized(Point{1, east / 10, north / 10}); }

Ring box(double west, double east, double south, double north) {
  return {near_x(west, south), near_x(east, south), near_x(east, north), near_x(west, north)};
}

// Cells of one ring each; equal points have one index.
CellRings cells_of(const std::vector<Ring>& rings) {
  CellRings cells;
  for (const Ring& ring : rings) {
    for (const Point& p : ring) {
      const auto at = std::ranges::find(cells.points, p);
      cells.corners.push_back(static_cast<Index>(at - cells.points.begin()));
      if (at == cells.points.end()) cells.points.push_back(p);
    }
    cells.rings.push_back(cells.corners.size());
    cells.cells.push_back(cells.rings.size() - 1);
  }
  return cells;
}

Subdivision subdivision_of(const std::vector<Ring>& rings) { return {cells_of(rings), false, 1}; }

std::optional<SideConflict> conflict_of(const std::vector<Ring>& rings) {
  return overlay::side_conflict(subdivision_of(rings), {});
}

// Expects triangles that cover the sphere, and those of each cell to add up to its area.
void expect_filling(const std::vector<Ring>& rings) {
  const Subdivision cells = subdivision_of(rings);
  const CoverTriangulation filling = overlay::triangulate_cover(cells, {});
  EXPECT_TRUE(filling.cover.is_closed);
  ASSERT_EQ(filling.owners.size(), filling.cover.num_cells());
  std::vector<double> areas(rings.size() + 1);
  for (Index i = 0; i < filling.cover.num_cells(); ++i) {
    EXPECT_EQ(filling.cover.end_of(i) - filling.cover.begin_of(i), 3U);
    ASSERT_LE(filling.owners[i], rings.size());
    areas[filling.owners[i]] += filling.cover.area_of_rings(i);
  }
  double total = 0;
  for (std::size_t cell = 0; cell < rings.size(); ++cell) {
    const double area = map::area_on_left(rings[cells.names[cell]]);
    EXPECT_NEAR(areas[cell], area < 0 ? area + 4 * std::numbers::pi : area, 1e-13);
  }
  total = std::accumulate(areas.begin(), areas.end(), 0.0);
  EXPECT_NEAR(total, 4 * std::numbers::pi, 1e-12);
}

TEST(filling, of_an_octant_is_the_eight_octants) {
  const Subdivision cells = subdivision_of({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const CoverTriangulation filling = overlay::triangulate_cover(cells, {});
  EXPECT_EQ(filling.cover.num_cells(), 8U);
  EXPECT_EQ(std::ranges::count(filling.owners, Index{0}), 1);
  EXPECT_EQ(std::ranges::count(filling.owners, Index{1}), 7);
  const auto own = std::ranges::find(filling.owners, Index{0}) - filling.owners.begin();
  const Point& center = filling.cover.centers[static_cast<std::size_t>(own)];
  EXPECT_GT(std::min({center.x, center.y, center.z}), 0.5);
}

TEST(filling, has_the_areas_of_the_cells) {
  expect_filling({box(1, 3, 1, 3)});
  expect_filling({box(1, 3, 1, 3), box(3, 5, 1, 3)});       // with a side in common
  expect_filling({box(1, 3, 1, 3), box(3, 5, 3, 5)});       // with a corner in common
  expect_filling({box(-3, -1, 1, 3), box(-3, 5, -3, -1)});  // across the equator and the meridian
  expect_filling(
      {{near_x(0, 0), near_x(9, 0), near_x(9, 1), near_x(1, 1), near_x(1, 9), near_x(0, 9)}});
  Ring all_but = box(1, 3, 1, 3);
  std::ranges::reverse(all_but);
  expect_filling({all_but});
  expect_filling({all_but, box(1, 2, 1, 3),
                  box(2, 3, 1, 3)});  // its hole is filled by two, with corners on its sides
}

TEST(side_conflict, is_nothing_where_cells_touch) {
  EXPECT_FALSE(conflict_of({box(1, 3, 1, 3), box(3, 5, 1, 3)}).has_value());
  EXPECT_FALSE(conflict_of({box(1, 3, 1, 3), box(3, 5, 3, 5)}).has_value());
  EXPECT_FALSE(conflict_of({box(1, 3, 1, 3), box(6, 8, 1, 3)}).has_value());
  EXPECT_FALSE(conflict_of({}).has_value());
}

TEST(side_conflict, is_where_sides_cross) {
  const auto conflict = conflict_of({box(6, 7, 6, 7), box(0, 4, 0, 4), box(2, 6, -2, 2)});
  ASSERT_TRUE(conflict.has_value());
  EXPECT_TRUE(conflict->is_crossing);
  EXPECT_EQ(conflict->first, 1U);
  EXPECT_EQ(conflict->second, 2U);
  // One of the two crossings, in (2, 0) and (4, 2).
  const Point& place = conflict->place;
  const auto away = [&](const Point& p) { return norm(place - p); };
  EXPECT_LT(std::min(away(near_x(2, 0)), away(near_x(4, 2))), 1e-14);
  EXPECT_THROW(overlay::triangulate_cover(subdivision_of({box(0, 4, 0, 4), box(2, 6, -2, 2)}), {}),
               overlay::ConflictingSides);
}

// No sides cross where one cell lies in another one.
TEST(side_conflict, is_a_place_in_two_cells) {
  const auto conflict = conflict_of({box(0, 5, 0, 5), box(1, 2, 1, 2)});
  ASSERT_TRUE(conflict.has_value());
  EXPECT_FALSE(conflict->is_crossing);
  EXPECT_EQ(conflict->first, 0U);
  EXPECT_EQ(conflict->second, 1U);
  const Point& place = conflict->place;
  EXPECT_GE(place.y / place.x, 0.1 - 1e-9);
  EXPECT_LE(place.y / place.x, 0.2 + 1e-9);
  try {
    overlay::triangulate_cover(subdivision_of({box(0, 5, 0, 5), box(1, 2, 1, 2)}), {});
    ADD_FAILURE() << "cells overlap";
  } catch (const overlay::ConflictingSides& error) {
    EXPECT_EQ(error.conflict().first, 0U);
    EXPECT_EQ(error.conflict().second, 1U);
  }
}

TEST(side_conflict, sides_in_both_directions_are_not_plain) {
  EXPECT_TRUE(overlay::has_plain_sides(subdivision_of({box(1, 3, 1, 3), box(3, 5, 1, 3)}), {}));
  EXPECT_FALSE(overlay::has_plain_sides(subdivision_of({box(0, 4, 0, 4), box(2, 6, -2, 2)}), {}));
  // A line leads from a corner away and back.
  const Ring spiked = {near_x(1, 1), near_x(3, 1), near_x(3, 3),
                       near_x(5, 5), near_x(3, 3), near_x(1, 3)};
  EXPECT_FALSE(overlay::has_plain_sides(subdivision_of({spiked}), {}));
  EXPECT_FALSE(conflict_of({spiked}).has_value());
}

TEST(side_conflict, is_region_where_sides_bound_one) {
  const auto sides_of = [](const Ring& ring) {
    std::vector<overlay::BorderArc> sides;
    for (std::size_t k = 0; k < ring.size(); ++k)
      sides.push_back({ring[k], ring[(k + 1) % ring.size()]});
    return sides;
  };
  EXPECT_TRUE(overlay::is_region(sides_of(box(1, 3, 1, 3)), {}));
  EXPECT_FALSE(
      overlay::is_region(sides_of({near_x(1, 1), near_x(3, 3), near_x(3, 1), near_x(1, 3)}), {}));
  std::vector<overlay::BorderArc> two = sides_of(box(1, 3, 1, 3));
  const std::vector<overlay::BorderArc> inner = sides_of(box(1.5, 2, 1.5, 2));
  two.insert(two.end(), inner.begin(), inner.end());
  EXPECT_FALSE(overlay::is_region(two, {}));  // twice inside of it
}

}  // namespace
}  // namespace rondel::test::of_filling
