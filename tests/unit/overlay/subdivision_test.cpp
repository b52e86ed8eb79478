// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Subdivision: cells with their halfedges, for example the eight octants of the sphere.
//
//              z
//             / \          The octant of +x, +y, +z has the corners x, y, z counterclockwise. Its halfedge from x to y has a
//            / A \         twin from y to x in the octant below it, whose corners are x, -z, y.
//           x --- y
//            \ B /
//             \ /
//             -z
#include "overlay/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "exact/vector.h"
#include "support/random.h"

namespace rondel::test::of_subdivision {
namespace {

using overlay::Halfedge;
using overlay::Shape;
using overlay::Subdivision;
using Rings = std::vector<std::vector<Index>>;

// Cells of these rings, each of which is an outer ring or a hole.
CellRings cells_of(const std::vector<Point>& points, const std::vector<Rings>& cells) {
  CellRings result;
  result.points = points;
  for (const Rings& rings : cells) {
    for (const std::vector<Index>& ring : rings) {
      result.corners.insert(result.corners.end(), ring.begin(), ring.end());
      result.rings.push_back(result.corners.size());
    }
    result.cells.push_back(result.rings.size() - 1);
  }
  return result;
}

enum Axis : Index { x, y, z, west, south, down };  // west is -x, south is -y, down is -z
const std::vector<Point> axes = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                 {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
const std::vector<Rings> octants = {{{x, y, z}},        {{x, down, y}},       {{x, z, south}},
                                    {{x, south, down}}, {{west, z, y}},       {{west, y, down}},
                                    {{west, south, z}}, {{west, down, south}}};

// Expects that each halfedge leads to the origin of the next one and its twin leads back, in another cell.
void expect_halfedges(const Subdivision& all) {
  for (Halfedge h = 0; h < all.num_halfedges(); ++h) {
    const Halfedge next = all.next(h);
    EXPECT_EQ(all.previous(next), h);
    EXPECT_EQ(all.cell_of[next], all.cell_of[h]);
    EXPECT_EQ(all.end(h), all.origin(next));
    const Halfedge twin = all.twins[h];
    if (twin == no_index) continue;
    EXPECT_EQ(all.twins[twin], h);
    EXPECT_EQ(all.corners[twin], all.corners[next]);
    EXPECT_EQ(all.corners[all.next(twin)], all.corners[h]);
    EXPECT_NE(all.cell_of[twin], all.cell_of[h]);
  }
}

TEST(subdivision, of_octants_is_closed) {
  const Subdivision all(cells_of(axes, octants), false, 1);
  EXPECT_EQ(all.num_cells(), 8U);
  EXPECT_EQ(all.num_halfedges(), 24U);
  EXPECT_EQ(all.points.size(), 6U);
  EXPECT_TRUE(all.is_closed);
  EXPECT_TRUE(all.areas_of_others.empty());
  EXPECT_TRUE(std::ranges::is_sorted(all.keys));
  EXPECT_EQ(std::ranges::count(all.twins, no_index), 0);
  expect_halfedges(all);
  for (Index cell = 0; cell < 8; ++cell) {
    EXPECT_EQ(all.shapes[cell], Shape::convex);
    EXPECT_EQ(all.end_of(cell) - all.begin_of(cell), 3U);
    // The center is in the middle of the octant with this name.
    Point sum{};
    for (const Index corner : octants[all.names[cell]][0]) sum = sum + axes[corner];
    const Point& center = all.centers[cell];
    EXPECT_NEAR(center.x, sum.x / std::sqrt(3), 1e-15);
    EXPECT_NEAR(center.y, sum.y / std::sqrt(3), 1e-15);
    EXPECT_NEAR(center.z, sum.z / std::sqrt(3), 1e-15);
    EXPECT_NEAR(all.area_of_rings(cell), std::numbers::pi / 2, 1e-14);
    // The ring begins with the corner that has the least coordinates, which was at given_starts in the ring of the input.
    const Halfedge begin = all.begin_of(cell);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(all.origin(begin + static_cast<Index>(k)),
                axes[octants[all.names[cell]][0][(all.given_starts[cell] + k) % 3]]);
      const Point& first = all.origin(begin);
      const Point& other = all.origin(begin + static_cast<Index>(k));
      EXPECT_LE(std::tuple(first.x, first.y, first.z), std::tuple(other.x, other.y, other.z));
    }
  }
}

// Only the names of cells depend on the order in which they and their corners are given.
TEST(subdivision, is_the_same_in_any_order_of_the_input) {
  Random random(84);
  const Subdivision expected(cells_of(axes, octants), false, 1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Index> order(8);
    std::iota(order.begin(), order.end(), Index{0});
    random.shuffle(order);
    std::vector<Rings> cells;
    for (const Index i : order) {
      cells.push_back(octants[i]);
      std::vector<Index>& ring = cells.back()[0];
      std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                  ring.end());
    }
    const Subdivision all(cells_of(axes, cells), false, 2);
    EXPECT_TRUE(all.points == expected.points);
    EXPECT_TRUE(std::ranges::equal(all.corners, expected.corners));
    EXPECT_TRUE(std::ranges::equal(all.twins, expected.twins));
    for (std::size_t cell = 0; cell < 8; ++cell)
      EXPECT_EQ(order[all.names[cell]], expected.names[cell]);
  }
}

// Without the octant of +x, +y, +z, its three neighbors have a halfedge each with no cell beyond.
TEST(subdivision, with_a_gap_is_not_closed) {
  const Subdivision all(cells_of(axes, {octants.begin() + 1, octants.end()}), false, 1);
  EXPECT_FALSE(all.is_closed);
  EXPECT_EQ(std::ranges::count(all.twins, no_index), 3);
  expect_halfedges(all);
  std::set<std::tuple<double, double, double>> ends;
  for (Halfedge h = 0; h < all.num_halfedges(); ++h) {
    const Point& p = all.origin(h);
    if (all.twins[h] == no_index) ends.insert({p.x, p.y, p.z});
  }
  EXPECT_EQ(ends, (std::set<std::tuple<double, double, double>>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  const Subdivision nothing(CellRings{}, false, 1);
  EXPECT_FALSE(nothing.is_closed);
  EXPECT_EQ(nothing.num_cells(), 0U);
}

// A position on a map around (1, 0, 0), with east and north in tenths of the radius.
Point near_x(double east, double north) { return normalized(Point{1, east / 10, north / 10}); }

// One cell of one ring.
Shape shape_of(const std::vector<Point>& ring) {
  std::vector<Index> corners(ring.size());
  std::iota(corners.begin(), corners.end(), Index{0});
  return Subdivision(cells_of(ring, {{corners}}), false, 1).shapes[0];
}

TEST(subdivision, tells_the_shapes_of_cells) {
  EXPECT_EQ(shape_of({near_x(0, 0), near_x(2, 0), near_x(2, 2), near_x(0, 2)}), Shape::convex);
  // A corner in the middle of a side, and one in a notch that all corners can be seen from.
  EXPECT_EQ(shape_of({axes[x], axes[y], axes[west], axes[z]}), Shape::star);
  EXPECT_EQ(shape_of({near_x(0, 0), near_x(2, 0), near_x(2, 2), near_x(1, 1.9), near_x(0, 2)}),
            Shape::star);
  // The center of an L with long arms is in none of them; that of a C is not either.
  EXPECT_EQ(shape_of({near_x(0, 0), near_x(9, 0), near_x(9, 1), near_x(1, 1), near_x(1, 9),
                      near_x(0, 9)}),
            Shape::other);
  EXPECT_EQ(shape_of({near_x(0, 0), near_x(4, 0), near_x(4, 1), near_x(1, 1), near_x(1, 3),
                      near_x(4, 3), near_x(4, 4), near_x(0, 4)}),
            Shape::other);
  // A hemisphere has its border at a right angle from the center; a little more is too much.
  EXPECT_EQ(shape_of({axes[x], axes[y], axes[west], axes[south]}), Shape::star);
  std::vector<Point> more = {{1, 0, -0.1}, {0, 1, -0.1}, {-1, 0, -0.1}, {0, -1, -0.1}};
  for (Point& p : more) p = normalized(p);
  EXPECT_EQ(shape_of(more), Shape::other);
  // All but a square.
  EXPECT_EQ(shape_of({near_x(0, 2), near_x(2, 2), near_x(2, 0), near_x(0, 0)}), Shape::other);
  // A ring that goes around twice turns left at all corners.
  std::vector<Point> twice;
  for (const double angle : {0.0, 0.4, 0.8, 0.2, 0.6}) {
    const double turn = 2 * std::numbers::pi * angle;
    twice.push_back(near_x(std::cos(turn), std::sin(turn)));
  }
  EXPECT_EQ(shape_of(twice), Shape::other);
}

// Squares around one center, which the curve cannot tell apart, are in the order of their least corners.
TEST(subdivision, cells_with_one_center_have_one_order) {
  std::vector<Point> points;
  for (const double half : {1.0, 2.0, 3.0}) {
    for (const auto& [east, north] :
         {std::array{-half, -half}, {half, -half}, {half, half}, {-half, half}})
      points.push_back(near_x(east, north));
  }
  std::vector<Rings> squares = {{{0, 1, 2, 3}}, {{4, 5, 6, 7}}, {{8, 9, 10, 11}}};
  const Subdivision expected(cells_of(points, squares), false, 1);
  EXPECT_EQ(expected.keys[0], expected.keys[2]);
  EXPECT_TRUE(std::ranges::equal(expected.names, std::vector<Index>{2, 1, 0}));
  std::ranges::reverse(squares);
  const Subdivision other(cells_of(points, squares), false, 1);
  EXPECT_TRUE(std::ranges::equal(other.names, std::vector<Index>{0, 1, 2}));
  EXPECT_TRUE(other.points == expected.points);
}

// A frame with an island of its own, a cell without a ring, and the hole of the frame.
TEST(subdivision, knows_the_areas_of_cells_with_several_rings) {
  std::vector<Point> points;
  for (const double half : {4.0, 3.0, 2.0}) {
    for (const auto& [east, north] :
         {std::array{-half, -half}, {half, -half}, {half, half}, {-half, half}})
      points.push_back(near_x(east, north));
  }
  const Subdivision all(
      cells_of(points,
               {{{3, 2, 1, 0}}, {{0, 1, 2, 3}, {7, 6, 5, 4}, {8, 9, 10, 11}}, {}, {{4, 5, 6, 7}}}),
      false, 1);
  const auto place_of = [&](Index name) {
    return static_cast<Index>(std::ranges::find(all.names, name) - all.names.begin());
  };
  const auto square = [](double half) {  // of a gnomonic square: four right triangles
    const double t = half / 10;
    return 4 * std::asin(t * t / (1 + t * t));
  };
  EXPECT_EQ(all.shapes[place_of(1)], Shape::other);
  EXPECT_EQ(all.shapes[place_of(2)], Shape::empty);
  EXPECT_EQ(all.shapes[place_of(3)], Shape::convex);
  EXPECT_EQ(all.areas_of_others.size(), 2U);
  EXPECT_NEAR(all.area_of_other(place_of(1)), square(4) - square(3) + square(2), 1e-14);
  EXPECT_NEAR(all.area_of_other(place_of(0)), 4 * std::numbers::pi - square(4), 1e-14);
  EXPECT_FALSE(all.is_closed);
  std::vector<Point> ring;
  all.copy_ring(all.cells[place_of(3)], ring);
  EXPECT_EQ(ring.size(), 4U);
}

// At x, two corners are a rounding apart: the octants A of (+y, +z) and C of (-y, -z) have a short edge in common.
//
//       D  \  A          Where e is positive, the ring of A goes counterclockwise from z by x1 and x2 to y. Where it is
//           x1           negative, rounding has exchanged the two corners.
//             x2
//          C    \  B
std::vector<Rings> octants_with_short_edge() {
  std::vector<Rings> cells = octants;
  constexpr Index x1 = x;
  constexpr Index x2 = 6;
  cells[0] = {{x1, x2, y, z}};
  cells[1] = {{x2, down, y}};
  cells[2] = {{x1, z, south}};
  cells[3] = {{x1, south, down, x2}};
  return cells;
}

std::vector<Point> axes_with_two(double e) {
  std::vector<Point> points = axes;
  points[x] = {1, -e, e};
  points.push_back({1, e, -e});
  return points;
}

TEST(subdivision, merges_corners_that_rounding_has_exchanged) {
  for (const double e : {1e-15, -1e-15}) {
    for (const bool is_rounded : {true, false}) {
      const Subdivision all(cells_of(axes_with_two(e), octants_with_short_edge()), is_rounded, 1);
      const bool is_merged = is_rounded && e < 0;
      EXPECT_EQ(all.num_halfedges(), is_merged ? 24U : 26U);
      EXPECT_EQ(all.given_starts.empty(), is_merged);
      EXPECT_EQ(std::ranges::count(all.twins, no_index), 0);
      EXPECT_EQ(all.is_closed, is_merged || e > 0);
      expect_halfedges(all);
    }
  }
  // A long edge is not shortened, whatever its direction.
  const Subdivision wide(cells_of(axes_with_two(-1e-3), octants_with_short_edge()), true, 1);
  EXPECT_EQ(wide.num_halfedges(), 26U);
}

// Between A and B, along the edge from x to y, lies a cell N whose corners at y are in the right order and those at x are
// not. Its ring is lost, and A and B are neighbors.
TEST(subdivision, drops_a_cell_narrower_than_rounding) {
  constexpr double e = 1e-15;
  std::vector<Point> points = axes;
  constexpr Index x2 = 6;
  constexpr Index y2 = 7;
  points[x] = {1, 0, -e};
  points.push_back({1, 0, e});
  points[y] = {0, 1, e};
  points.push_back({0, 1, -e});
  std::vector<Rings> cells = octants;
  cells[1] = {{x2, down, y2}};
  cells[2] = {{x, z, south, x2}};
  cells[3] = {{x2, south, down}};
  cells[4] = {{west, z, y, y2}};
  cells[5] = {{west, y2, down}};
  cells.push_back({{x2, y2, y, x}});
  const Subdivision all(cells_of(points, cells), true, 1);
  EXPECT_EQ(all.num_cells(), 9U);
  EXPECT_EQ(all.num_halfedges(), 24U);
  EXPECT_TRUE(all.is_closed);
  expect_halfedges(all);
  const auto place = std::ranges::find(all.names, Index{8}) - all.names.begin();
  EXPECT_EQ(all.shapes[static_cast<std::size_t>(place)], Shape::empty);
}

}  // namespace
}  // namespace rondel::test::of_subdivision
