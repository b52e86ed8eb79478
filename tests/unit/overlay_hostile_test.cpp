// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Overlays of all generators with themselves and with others: nothing is lost, nothing counted twice.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "overlay_grid_oracle.h"
#include "rondel/regions.h"
#include "support/query_oracle.h"

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
void expect_whole_polygons(const Partition& cells, const Partition& other,
                           const std::string& name) {
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

Partition cells_of(const Generator& generator, std::size_t n, std::uint64_t seed) {
  const SiteSet set = generator.make(n, seed);
  const Model model = generator.weighted_only ? Model::weighted : Model::projected;
  return Partition::voronoi(delaunay(set.sites, {.model = model, .sphere = set.sphere}));
}

TEST_P(OverlayHostile, nothing_is_lost) {
  const Generator& generator = generators()[GetParam()];
  if (generator.has_long_integers && is_shortened()) GTEST_SKIP();
  const std::size_t n = generator.has_long_integers ? 12 : 120;
  const Partition cells = cells_of(generator, n, 5);
  const Partition other = cells_of(generator, n + n / 2, 7);
  const Partition uniform = Partition::voronoi(triangulation_of("uniform", 100, 7));
  const std::string name(generator.name);
  expect_a_cover(remap(cells, uniform, {.order = 2}), name + " to uniform");
  expect_a_cover(remap(uniform, cells, {.order = 2}), "uniform to " + name);
  for (const std::size_t num_lon : {1U, 4U, 90U}) {
    const Partition grid = Partition::lonlat_grid(regular_grid(num_lon, num_lon * 3));
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

// The middle of a cell, from which corners are looked for, is a corner of the other diagram but for its length, an ulp.
TEST(overlay_hostile, corners_in_the_middle_of_cells) {
  const std::vector<Point> sites = {{0, 0, 1}, {-3, 0, 0}, {0, 0, -1}, {0, -3, 0}};
  const std::vector<Point> others = {{0, -3, 0}, {-0.1875, 0, 0}, {3, 0, 0},
                                     {0, 0, -3}, {-1, -1, -1},    {0, 0, 1}};
  const Partition cells = Partition::voronoi(delaunay(sites));
  const Partition other = Partition::voronoi(delaunay(others));
  expect_a_cover(remap(cells, other), "there");
  expect_a_cover(remap(other, cells), "back");
}

// As one is turned by less than an ulp and more, pieces appear, but no area does.
TEST(overlay_hostile, turned_by_little) {
  const SiteSet set = generator("uniform").make(1000, 20);
  const Partition cells = Partition::voronoi(delaunay(set.sites));
  for (const double angle : {1e-17, 1e-16, 1e-15, 1e-12, 1e-8}) {
    std::vector<Point> turned;
    for (const Point& p : set.sites) {
      turned.push_back({p.x - angle * p.y, p.y + angle * p.x, p.z});
    }
    expect_a_cover(remap(cells, Partition::voronoi(delaunay(turned))), std::to_string(angle));
  }
}

}  // namespace
}  // namespace rondel::test
