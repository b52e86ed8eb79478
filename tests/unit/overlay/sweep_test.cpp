// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// sweep_rings(): the border of the polygons of a feature, or the first place that makes no sense.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "map/map_plane.h"
#include "overlay/plane_sweep.h"

namespace rondel::test::of_sweep {
namespace {

using map::LonLatRing;
using overlay::PlaneFaultKind;
using overlay::PlaneRegion;
using Positions = std::vector<LonLat>;
using Rings = std::vector<LonLatRing>;

LonLatRing shell(Positions positions) { return {.positions = std::move(positions)}; }
LonLatRing hole(Positions positions) {
  return {.positions = std::move(positions), .is_hole = true};
}
Positions box(double west, double east, double south, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}
Positions backward(Positions positions) {
  std::ranges::reverse(positions);
  return positions;
}

// The sides of a region sorted, from the first end on.
std::vector<std::pair<LonLat, LonLat>> sorted_sides(const PlaneRegion& region) {
  std::vector<std::pair<LonLat, LonLat>> sides;
  for (const overlay::PlaneSide& side : region.sides) sides.emplace_back(side.from, side.to);
  std::ranges::sort(sides, [](const auto& x, const auto& y) {
    return x.first == y.first ? map::InPlane()(x.second, y.second)
                              : map::InPlane()(x.first, y.first);
  });
  return sides;
}

// Expects the sides of these loops, with the region to their left.
void expect_sides(const Rings& rings, const std::vector<Positions>& loops) {
  const PlaneRegion region = overlay::sweep_rings(rings);
  EXPECT_FALSE(region.fault.has_value());
  PlaneRegion expected;
  for (const Positions& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      expected.sides.push_back({loop[k], loop[(k + 1) % loop.size()]});
  }
  EXPECT_EQ(sorted_sides(region), sorted_sides(expected));
}

void expect_fault(const Rings& rings, PlaneFaultKind kind, Index first, Index second,
                  const LonLat& place) {
  const PlaneRegion region = overlay::sweep_rings(rings);
  ASSERT_TRUE(region.fault.has_value());
  EXPECT_TRUE(region.sides.empty());
  EXPECT_EQ(region.fault->kind, kind);
  EXPECT_EQ(region.fault->first, first);
  EXPECT_EQ(region.fault->second, second);
  EXPECT_EQ(region.fault->place, place);
}

TEST(plane_sweep, has_the_inside_to_the_left_whatever_way_rings_are_given) {
  const Positions square = box(0, 4, 0, 4);
  const Positions inner = box(1, 3, 1, 3);
  expect_sides({shell(square)}, {square});
  expect_sides({shell(backward(square))}, {square});
  expect_sides({shell(square), hole(inner)}, {square, backward(inner)});
  expect_sides({shell(backward(square)), hole(backward(inner))}, {square, backward(inner)});
  expect_sides({shell(square), shell(box(6, 7, 0, 1))}, {square, box(6, 7, 0, 1)});
  // A polygon in the hole of another one.
  expect_sides({shell(square), hole(inner), shell(box(1.5, 2.5, 1.5, 2.5))},
               {square, backward(inner), box(1.5, 2.5, 1.5, 2.5)});
  expect_sides({}, {});
}

// The side that two squares share is no border, and a corner on a side divides it.
TEST(plane_sweep, sides_of_two_polygons_cancel) {
  expect_sides({shell(box(0, 2, 0, 2)), shell(box(2, 4, 0, 2))},
               {{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {0, 2}}});
  expect_sides({shell(box(0, 4, 0, 4)), shell(box(4, 6, 1, 3))},
               {{{0, 0}, {4, 0}, {4, 1}, {6, 1}, {6, 3}, {4, 3}, {4, 4}, {0, 4}}});
}

// A hole with a side of its shell leaves a bay; a ring that touches itself in a corner has two loops.
TEST(plane_sweep, rings_are_read_even_odd) {
  expect_sides({shell({{0, 0}, {4, 0}, {4, 1}, {4, 3}, {4, 4}, {0, 4}}), hole(box(2, 4, 1, 3))},
               {{{0, 0}, {4, 0}, {4, 1}, {2, 1}, {2, 3}, {4, 3}, {4, 4}, {0, 4}}});
  expect_sides({shell({{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}})},
               {box(0, 2, 0, 2), box(2, 4, 2, 4)});
  // A spike is no part of the region.
  expect_sides({shell({{0, 0}, {2, 0}, {5, 0}, {2, 0}, {2, 2}, {0, 2}})}, {box(0, 2, 0, 2)});
}

TEST(plane_sweep, tells_where_sides_cross) {
  expect_fault({shell({{0, 0}, {4, 4}, {4, 0}, {0, 4}})}, PlaneFaultKind::crossing, 0, 0, {2, 2});
  expect_fault({shell(box(10, 11, 0, 1)), shell(box(0, 4, 0, 4)), shell(box(2, 6, -2, 2))},
               PlaneFaultKind::crossing, 1, 2, {2, 0});
  expect_fault({shell(box(0, 4, 0, 4)), hole(box(3, 5, 1, 2))}, PlaneFaultKind::crossing, 0, 1,
               {4, 1});
}

TEST(plane_sweep, tells_which_polygon_lies_in_another_one) {
  const PlaneRegion region =
      overlay::sweep_rings(Rings{shell(box(0, 9, 0, 9)), shell(box(2, 4, 2, 4))});
  ASSERT_TRUE(region.fault.has_value());
  EXPECT_EQ(region.fault->kind, PlaneFaultKind::overlap);
  EXPECT_EQ(region.fault->first, 0U);
  EXPECT_EQ(region.fault->second, 1U);
}

TEST(plane_sweep, tells_which_hole_is_not_in_its_shell) {
  for (const auto& [rings, first, second] :
       {std::tuple(Rings{shell(box(0, 4, 0, 4)), hole(box(6, 7, 0, 1))}, no_index, 1U),
        std::tuple(Rings{shell(box(0, 9, 0, 9)), hole(box(1, 8, 1, 8)), hole(box(2, 4, 2, 4))}, 1U,
                   2U)}) {
    const PlaneRegion region = overlay::sweep_rings(rings);
    ASSERT_TRUE(region.fault.has_value());
    EXPECT_EQ(region.fault->kind, PlaneFaultKind::outside);
    EXPECT_EQ(region.fault->first, first);
    EXPECT_EQ(region.fault->second, second);
  }
}

TEST(plane_sweep, tells_what_has_no_area) {
  const PlaneRegion line =
      overlay::sweep_rings(Rings{shell(box(6, 7, 0, 1)), shell({{0, 0}, {2, 0}, {1, 0}})});
  ASSERT_TRUE(line.fault.has_value());
  EXPECT_EQ(line.fault->kind, PlaneFaultKind::no_area);
  EXPECT_EQ(line.fault->first, 1U);
  const PlaneRegion filled = overlay::sweep_rings(Rings{
      shell(box(0, 4, 0, 4)), hole({{0, 0}, {4, 0}, {4, 4}}), hole({{0, 0}, {4, 4}, {0, 4}})});
  ASSERT_TRUE(filled.fault.has_value());
  EXPECT_EQ(filled.fault->kind, PlaneFaultKind::filled);
  EXPECT_EQ(filled.fault->first, 0U);
}

// The westernmost fault is told, whatever the order of rings.
TEST(plane_sweep, tells_the_westernmost_fault) {
  const LonLatRing east = shell({{10, 0}, {14, 4}, {14, 0}, {10, 4}});
  const LonLatRing west = shell({{0, 0}, {4, 4}, {4, 0}, {0, 4}});
  expect_fault({east, west}, PlaneFaultKind::crossing, 1, 1, {2, 2});
  expect_fault({west, east}, PlaneFaultKind::crossing, 0, 0, {2, 2});
}

}  // namespace
}  // namespace rondel::test::of_sweep
