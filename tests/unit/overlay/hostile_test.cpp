// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Overlays of all generators with themselves and with others: nothing is lost, nothing counted twice.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "rondel/regions.h"
#include "support/query_oracle.h"
#include "unit/overlay/grid_oracle.h"

namespace rondel::test {
namespace {

// Cells that are narrower than rounding may lose what others gain.
void expect_a_cover(const Remap& remap, const std::string& name) {
  const double sum = std::accumulate(remap.areas.begin(), remap.areas.end(), 0.0);
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-11) << name;
  for (const double area : remap.areas) EXPECT_GT(area, 0) << name;
  for (std::size_t i = 0; i < remap.source_areas.size(); ++i) {
    const double area = remap.source_areas[i];
    if (!(area > 1e-9)) continue;
    EXPECT_NEAR(remap.source_fractions[i], 1, 1e-14 / area + 1e-13) << name << ' ' << i;
  }
  for (std::size_t j = 0; j < remap.target_areas.size(); ++j) {
    const double area = remap.target_areas[j];
    if (!(area > 1e-9)) continue;
    EXPECT_NEAR(remap.target_fractions[j], 1, 1e-14 / area + 1e-13) << name << ' ' << j;
  }
}

// The area of the pieces as polygons is that of the cells, and so is that of what is joined of them.
void expect_whole_polygons(const CellSet& cells, const CellSet& other, const std::string& name) {
  const RegionPieces pieces = intersection(cells, other);
  const CellRings joined = dissolve(pieces.rings, pieces.cells, cells.num_cells());
  const std::vector<double> of_pieces = areas(pieces.rings);
  const std::vector<double> of_joined = areas(joined);
  std::vector<double> sums(cells.num_cells());
  for (std::size_t k = 0; k < pieces.num_pieces(); ++k) sums[pieces.cells[k]] += of_pieces[k];
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (cells.areas()[i] > 12) continue;  // nearly the sphere
    EXPECT_NEAR(sums[i], cells.areas()[i], 1e-13) << name << ' ' << i;
    EXPECT_NEAR(of_joined[i], cells.areas()[i], 1e-13) << name << ' ' << i;
  }
}

class OverlayHostile : public testing::TestWithParam<std::size_t> {};

CellSet cells_of(const Generator& generator, std::size_t n, std::uint64_t seed) {
  const SiteSet set = generator.make(n, seed);
  const Model model = generator.weighted_only ? Model::weighted : Model::projected;
  return CellSet::voronoi(delaunay(set.sites, {.model = model, .sphere = set.sphere}));
}

TEST_P(OverlayHostile, nothing_is_lost) {
  const Generator& generator = generators()[GetParam()];
  if (generator.has_long_integers && is_shortened()) GTEST_SKIP();
  const std::size_t n = generator.has_long_integers ? 12 : 120;
  const CellSet cells = cells_of(generator, n, 5);
  const CellSet other = cells_of(generator, n + n / 2, 7);
  const CellSet uniform = CellSet::voronoi(triangulation_of("uniform", 100, 7));
  const std::string name(generator.name);
  expect_a_cover(remap(cells, uniform, {.order = 2}), name + " to uniform");
  expect_a_cover(remap(uniform, cells, {.order = 2}), "uniform to " + name);
  for (const std::size_t num_lon : {1U, 4U, 90U}) {
    const CellSet grid = CellSet::lonlat_grid(regular_grid(num_lon, num_lon * 3));
    expect_a_cover(remap(cells, grid, {.order = 2}), name + " to a grid");
    expect_a_cover(remap(grid, cells, {.order = 2}), "grid to " + name);
  }
  expect_a_cover(remap(cells, cells), name + " with itself");
  expect_a_cover(remap(cells, other), name + " with another");
  expect_whole_polygons(cells, cells, name + " with itself");
  expect_whole_polygons(cells, other, name + " with another");
}

INSTANTIATE_TEST_SUITE_P(overlay, OverlayHostile,
                         testing::Range(std::size_t{0}, generators().size()), [](const auto& test) {
                           return std::string(generators()[test.param].name);
                         });

// Two cells, around the poles: a ring of corners at two latitudes by turns, and its rest.
CellRings caps(Index num_corners, double even, double odd) {
  CellRings rings;
  for (Index k = 0; k < num_corners; ++k) {
    const double height = k % 2 == 0 ? even : odd;
    const double radius = std::sqrt(1 - height * height);
    const double turn = 2 * std::numbers::pi * (k + 0.25) / num_corners;
    rings.points.push_back({radius * std::cos(turn), radius * std::sin(turn), height});
    rings.corners.push_back(k);
  }
  for (Index k = num_corners; k > 0; --k) rings.corners.push_back(k - 1);
  rings.rings.insert(rings.rings.end(), {num_corners, 2 * std::uint64_t{num_corners}});
  rings.cells = {0, 1, 2};
  return rings;
}

TEST(overlay_hostile, cells_of_many_corners_are_those_of_clipping) {
  const auto sites = triangulation_of("uniform", 120, 3);
  const CellSet others = CellSet::voronoi(sites);
  const Cells convex = cells(sites);
  for (const Index num_corners : {10U, 64U, 302U}) {
    for (const auto& [even, odd] : {std::pair{0.2, 0.2}, {0.9, 0.9}, {0.3, 0.7}, {0.1, 0.15}}) {
      const CellRings rings = caps(num_corners, even, odd);
      const CellSet two = CellSet::polygons(rings);
      const Remap there = rondel::remap(two, others);
      const Remap back = rondel::remap(others, two);
      LongRing cap;
      for (const Point& p : rings.points) cap.push_back(long_vector(p));
      for (std::size_t j = 0; j < others.num_cells(); ++j) {
        const auto north = static_cast<double>(area_of_piece(cap, convex, j));
        const double south = others.areas()[j] - north;
        EXPECT_NEAR(piece_of(there, 0, j), north, 1e-14) << num_corners << ' ' << even << ' ' << j;
        EXPECT_NEAR(piece_of(there, 1, j), south, 1e-14) << num_corners << ' ' << even << ' ' << j;
        EXPECT_NEAR(piece_of(back, j, 0), north, 1e-14) << num_corners << ' ' << even << ' ' << j;
        EXPECT_NEAR(piece_of(back, j, 1), south, 1e-14) << num_corners << ' ' << even << ' ' << j;
      }
    }
  }
}

// The middle of a cell, from which corners are looked for, is a corner of the other diagram but for its length, an ulp.
TEST(overlay_hostile, corners_in_the_middle_of_cells) {
  const std::vector<Point> sites = {{0, 0, 1}, {-3, 0, 0}, {0, 0, -1}, {0, -3, 0}};
  const std::vector<Point> others = {{0, -3, 0}, {-0.1875, 0, 0}, {3, 0, 0},
                                     {0, 0, -3}, {-1, -1, -1},    {0, 0, 1}};
  const CellSet cells = CellSet::voronoi(delaunay(sites));
  const CellSet other = CellSet::voronoi(delaunay(others));
  expect_a_cover(remap(cells, other), "there");
  expect_a_cover(remap(other, cells), "back");
}

// As one is turned by less than an ulp and more, pieces appear, but no area does.
TEST(overlay_hostile, turned_by_little) {
  const SiteSet set = generator("uniform").make(1000, 20);
  const CellSet cells = CellSet::voronoi(delaunay(set.sites));
  for (const double angle : {1e-17, 1e-16, 1e-15, 1e-12, 1e-8}) {
    std::vector<Point> turned;
    for (const Point& p : set.sites) {
      turned.push_back({p.x - angle * p.y, p.y + angle * p.x, p.z});
    }
    expect_a_cover(remap(cells, CellSet::voronoi(delaunay(turned))), std::to_string(angle));
  }
}

}  // namespace
}  // namespace rondel::test
