// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A cell that is the whole sphere has no border, and is not the same as a cell of which nothing is left.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double sphere = 4 * std::numbers::pi;

CellRings whole_sphere() {
  CellRings cells;
  cells.cells = {0, 0};
  cells.whole = {0};
  return cells;
}

TEST(overlay_whole, the_sphere_has_an_area_and_comes_back) {
  const CellSet sphere_cell = CellSet::polygons(whole_sphere());
  EXPECT_EQ(sphere_cell.areas()[0], sphere);
  EXPECT_TRUE(sphere_cell.is_cover());
  EXPECT_EQ(sphere_cell.rings().whole, std::vector<Index>{0});
  EXPECT_EQ(areas(whole_sphere())[0], sphere);
  const CellSet one = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}}));
  EXPECT_EQ(one.rings().whole, std::vector<Index>{0});
  EXPECT_EQ(areas(one.rings())[0], sphere);
}

TEST(overlay_whole, cells_that_cover_it_dissolve_to_it) {
  const CellRings cells = CellSet::voronoi(triangulation_of("uniform", 200, 3)).rings();
  const CellRings joined = dissolve(cells, std::vector<Index>(200, 1), 3);
  EXPECT_EQ(joined.whole, std::vector<Index>{1});
  EXPECT_EQ(areas(joined), (std::vector<double>{0, sphere, 0}));
  EXPECT_EQ(dissolve(joined, std::vector<Index>{0, 0, 0}, 1).whole, std::vector<Index>{0});
  EXPECT_TRUE(dissolve(cells, std::vector<Index>(200, no_index), 1).whole.empty());
}

TEST(overlay_whole, clipping_by_it_changes_nothing) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 300, 4));
  const CellSet all = CellSet::polygons(whole_sphere());
  const CellRings clipped = clip(cells, all);
  EXPECT_TRUE(clipped.whole.empty());
  const std::vector<double> found = areas(clipped);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], cells.areas()[i], 1e-15);
  EXPECT_EQ(clip(all, cells).whole, std::vector<Index>{0});
  EXPECT_EQ(clip(all, all).whole, std::vector<Index>{0});
  const RegionPieces pieces = intersection(all, all);
  ASSERT_EQ(pieces.num_pieces(), 1U);
  EXPECT_EQ(pieces.rings.whole, std::vector<Index>{0});
  EXPECT_EQ(areas(pieces.rings)[0], sphere);
}

// Two halves of the sphere with one border, each a little more than a half by rounding.
TEST(overlay_whole, halves_are_apart) {
  CellRings halves;
  constexpr double angle = 0.4;
  for (int k = 0; k < 5; ++k) {
    const double at = 1.2 * k;
    halves.points.push_back(unit_vector({at * 60, 10 * std::sin(at + angle)}));
  }
  halves.corners = {0, 1, 2, 3, 4, 4, 3, 2, 1, 0};
  halves.rings = {0, 5, 10};
  halves.cells = {0, 1, 2};
  const CellSet cells = CellSet::polygons(halves);
  const RegionPieces pieces = intersection(cells, cells);
  EXPECT_EQ(pieces.num_pieces(), 2U);
  EXPECT_TRUE(pieces.rings.whole.empty());
  const CellSet equator = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}, {0, 0, -1}}));
  const RegionPieces of_equator = intersection(equator, equator);
  EXPECT_TRUE(of_equator.rings.whole.empty());
}

TEST(overlay_whole, nothing_is_not_the_sphere) {
  CellRings nothing;
  nothing.cells = {0, 0};
  EXPECT_EQ(areas(nothing)[0], 0);
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 30, 5));
  EXPECT_TRUE(clip(CellSet::polygons(nothing), cells).whole.empty());
  EXPECT_TRUE(clip(CellSet::polygons(whole_sphere()), CellSet::polygons(nothing)).whole.empty());
  EXPECT_EQ(intersection(cells, CellSet::polygons(nothing)).num_pieces(), 0U);
}

TEST(overlay_whole, means_over_it_and_from_it) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 100, 6));
  const CellSet all = CellSet::polygons(whole_sphere());
  for (const unsigned order : {1U, 2U}) {
    const Remap to = remap(cells, all, {.order = order});
    std::vector<double> values(100);
    std::iota(values.begin(), values.end(), 1.0);
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) mean += values[i] * cells.areas()[i] / sphere;
    std::vector<double> out(1);
    apply(to.weights, values, out);
    EXPECT_NEAR(out[0], mean, 1e-12);
    const Remap from = remap(all, cells, {.order = order});
    std::vector<double> constant(100);
    apply(from.weights, std::vector<double>{7}, constant);
    for (const double value : constant) EXPECT_NEAR(value, 7, 1e-14);
  }
}

TEST(overlay_whole, a_name_that_does_not_fit_is_refused) {
  CellRings twice = whole_sphere();
  twice.whole = {0, 0};
  EXPECT_THROW((void)CellSet::polygons(twice), InvalidInput);
  CellRings beyond = whole_sphere();
  beyond.whole = {1};
  EXPECT_THROW((void)CellSet::polygons(beyond), InvalidInput);
  CellRings with_rings = CellSet::voronoi(triangulation_of("uniform", 20, 7)).rings();
  with_rings.whole = {3};
  EXPECT_THROW((void)CellSet::polygons(with_rings), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
