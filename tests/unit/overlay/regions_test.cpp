// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells cut by regions and joined by group: areas against those of remap(), borders that are shared by two.

#include "rondel/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>

#include "rondel/error.h"
#include "rondel/remap.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

using Coordinates = std::tuple<double, double, double>;
Coordinates coordinates(const Point& p) { return {p.x, p.y, p.z}; }

// How often each side occurs, by its ends; the way back counts as -1.
std::map<std::pair<Coordinates, Coordinates>, int> sides_of(const CellRings& cells) {
  std::map<std::pair<Coordinates, Coordinates>, int> sides;
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    for (std::uint64_t k = cells.rings[r]; k < cells.rings[r + 1]; ++k) {
      const std::uint64_t next = k + 1 < cells.rings[r + 1] ? k + 1 : cells.rings[r];
      const Coordinates from = coordinates(cells.points[cells.corners[k]]);
      const Coordinates to = coordinates(cells.points[cells.corners[next]]);
      ++sides[{from, to}];
      --sides[{to, from}];
    }
  }
  return sides;
}

bool is_closed(const CellRings& cells) {
  return std::ranges::all_of(sides_of(cells), [](const auto& side) { return side.second == 0; });
}

void expect_simple_rings(const CellRings& cells) {
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    std::vector<Index> ring(
        cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.rings[r]),
        cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.rings[r + 1]));
    EXPECT_GE(ring.size(), 3U);
    EXPECT_EQ(std::ranges::min_element(ring), ring.begin());
    std::ranges::sort(ring);
    EXPECT_EQ(std::ranges::adjacent_find(ring), ring.end());
  }
}

TEST(overlay_regions, lengths_are_those_of_all_sides) {
  CellRings cells;
  cells.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {-1, 0, 0}};
  cells.append_ring(std::vector<Index>{0, 1, 2});
  cells.end_cell();
  cells.end_cell();
  cells.whole = {2};
  cells.end_cell();
  cells.append_ring(std::vector<Index>{0, 3, 1, 4, 2});
  cells.append_ring(std::vector<Index>{0, 2, 1});
  cells.end_cell();
  const std::vector<double> found = lengths(cells);
  constexpr double quarter = std::numbers::pi / 2;
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NEAR(found[0], 3 * quarter, 1e-15);
  EXPECT_EQ(found[1], 0);
  EXPECT_EQ(found[2], 0);
  EXPECT_NEAR(found[3], 7 * quarter, 1e-15);
}

TEST(overlay_regions, lengths_of_short_and_long_sides) {
  const CellRings cells = CellSet::voronoi(triangulation_of("clustered", 1000, 3)).rings();
  const std::vector<double> found = lengths(cells);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    long double expected = 0;
    for (std::uint64_t r = cells.cells[i]; r < cells.cells[i + 1]; ++r) {
      const auto ring = cells.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point& p = cells.points[ring[k]];
        const Point& q = cells.points[ring[(k + 1) % ring.size()]];
        const auto square = [](long double x) { return x * x; };
        const long double chord = std::sqrt(square(static_cast<long double>(p.x) - q.x) +
                                            square(static_cast<long double>(p.y) - q.y) +
                                            square(static_cast<long double>(p.z) - q.z));
        expected += 2 * std::asin(chord / 2);
      }
    }
    ASSERT_NEAR(found[i], static_cast<double>(expected), 1e-14 * (1e-2 + found[i]));
  }
}

// Regions with holes and of many parts, some of the sphere in none.
CellRings random_regions(std::size_t n, Index num_groups, std::uint64_t seed) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", n, seed));
  return dissolve(cells.rings(), random_groups(n, num_groups, seed, true), num_groups);
}

std::size_t num_corners_of(const CellRings& cells, std::size_t cell) {
  return cells.rings[cells.cells[cell + 1]] - cells.rings[cells.cells[cell]];
}

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(overlay_regions, pieces_have_the_areas_of_the_overlay) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 900, 1));
  const CellSet regions = CellSet::polygons(random_regions(400, 3, 2));
  const RegionPieces pieces = intersection(cells, regions);
  const std::vector<double> found = areas(pieces.rings);
  const Remap remap = rondel::remap(cells, regions);
  ASSERT_EQ(pieces.num_pieces(), remap.areas.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k], piece_of(remap, pieces.cells[k], pieces.regions[k]), 1e-15);
  }
  expect_simple_rings(pieces.rings);
}

TEST(overlay_regions, pieces_of_covers_leave_no_gap) {
  const CellSet cells = CellSet::voronoi(triangulation_of("clustered", 2000, 3));
  const CellSet others = CellSet::voronoi(triangulation_of("uniform", 500, 4));
  const RegionPieces pieces = intersection(cells, others);
  EXPECT_TRUE(is_closed(pieces.rings));
  EXPECT_NEAR(sum(areas(pieces.rings)), 4 * std::numbers::pi, 1e-13);
}

TEST(overlay_regions, what_is_joined_again_is_what_was_cut) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 700, 5));
  const CellSet others = CellSet::voronoi(triangulation_of("uniform", 300, 6));
  const CellRings whole = clip(cells, others);
  const std::vector<double> found = areas(whole);
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    EXPECT_EQ(whole.cells[i + 1] - whole.cells[i], 1U);
    EXPECT_NEAR(found[i], cells.areas()[i], 1e-15);
  }
  const RegionPieces pieces = intersection(cells, others);
  const CellRings joined = dissolve(pieces.rings, pieces.cells, cells.num_cells());
  EXPECT_EQ(joined.corners, whole.corners);
  EXPECT_EQ(joined.rings, whole.rings);
  EXPECT_TRUE(joined.points == whole.points);
}

// By group of cells and group of regions: against the sums of the pieces' areas.
TEST(overlay_regions, pieces_are_joined_by_both_groups) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 500, 15));
  const CellSet regions = CellSet::voronoi(triangulation_of("uniform", 60, 16));
  const RegionPieces pieces = intersection(cells, regions);
  const auto group = [](Index i, Index num_groups) {
    return i % (num_groups + 1) == num_groups ? no_index : i % num_groups;
  };
  std::vector<Index> cell_groups(cells.num_cells());
  std::vector<Index> region_groups(regions.num_cells());
  for (Index i = 0; i < cell_groups.size(); ++i) cell_groups[i] = group(i, 5);
  for (Index i = 0; i < region_groups.size(); ++i) region_groups[i] = group(i, 3);
  std::map<std::pair<Index, Index>, double> expected;
  const std::vector<double> of_pieces = areas(pieces.rings);
  for (std::size_t k = 0; k < pieces.num_pieces(); ++k) {
    const Index a = cell_groups[pieces.cells[k]];
    const Index b = region_groups[pieces.regions[k]];
    if (a != no_index && b != no_index) expected[{a, b}] += of_pieces[k];
  }
  const RegionPieces joined = dissolve(pieces, cell_groups, region_groups);
  const std::vector<double> found = areas(joined.rings);
  ASSERT_EQ(joined.num_pieces(), expected.size());
  std::size_t k = 0;
  for (const auto& [pair, area] : expected) {
    EXPECT_EQ(std::pair(joined.cells[k], joined.regions[k]), pair);
    EXPECT_NEAR(found[k], area, 1e-13);
    ++k;
  }
  expect_simple_rings(joined.rings);
  const RegionPieces same = dissolve(pieces, {}, {});
  EXPECT_EQ(same.cells, pieces.cells);
  EXPECT_EQ(same.regions, pieces.regions);
  EXPECT_EQ(same.rings.corners, pieces.rings.corners);
  region_groups.resize(3);
  EXPECT_THROW(dissolve(pieces, cell_groups, region_groups), InvalidInput);
}

TEST(overlay_regions, clipped_cells_have_the_area_of_the_regions) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 3000, 7));
  const CellRings regions = random_regions(500, 4, 8);
  const CellRings clipped = clip(cells, CellSet::polygons(regions));
  EXPECT_NEAR(sum(areas(clipped)), sum(areas(regions)), 1e-13);
  expect_simple_rings(clipped);
  // Both ways around.
  const CellRings exchanged = clip(CellSet::polygons(regions), cells);
  const auto expected = areas(regions);
  const auto found = areas(exchanged);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-13);
}

TEST(overlay_regions, cells_clipped_to_themselves_are_themselves) {
  const CellSet cells = CellSet::voronoi(triangulation_of("globe_grid", 600, 9));
  const CellRings same = clip(cells, cells);
  EXPECT_TRUE(is_closed(same));
  const CellRings rings = cells.rings();
  const CellRings expected = dissolve(
      rings,
      [&] {
        std::vector<Index> groups(rings.num_cells());
        std::iota(groups.begin(), groups.end(), Index{0});
        return groups;
      }(),
      rings.num_cells());
  EXPECT_EQ(same.corners, expected.corners);
  EXPECT_EQ(same.rings, expected.rings);
  EXPECT_TRUE(same.points == expected.points);
}

TEST(overlay_regions, dissolved_cells_share_their_borders) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 5000, 10));
  const std::vector<Index> groups = random_groups(cells.num_cells(), 5, 11);
  const CellRings joined = dissolve(cells.rings(), groups, 5);
  EXPECT_TRUE(is_closed(joined));
  expect_simple_rings(joined);
  std::vector<double> expected(5);
  for (std::size_t i = 0; i < groups.size(); ++i) expected[groups[i]] += cells.areas()[i];
  const std::vector<double> found = areas(joined);
  for (std::size_t g = 0; g < 5; ++g) EXPECT_NEAR(found[g], expected[g], 1e-12);
}

TEST(overlay_regions, of_everything_nothing_is_left) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 100, 12));
  const CellRings all = dissolve(cells.rings(), std::vector<Index>(100, 0), 1);
  EXPECT_EQ(all.cells, (std::vector<std::uint64_t>{0, 0}));  // no border is left
  const CellRings none = dissolve(cells.rings(), std::vector<Index>(100, no_index), 1);
  EXPECT_TRUE(none.points.empty());
}

TEST(overlay_regions, threads_and_orders_make_no_difference) {
  const auto triangulation = triangulation_of("uniform", 3000, 13);
  const CellSet cells = CellSet::voronoi(triangulation);
  const CellSet regions = CellSet::polygons(random_regions(300, 2, 14));
  const CellRings one = clip(cells, regions, {.threads = 1});
  const CellRings four = clip(cells, regions, {.threads = 4});
  EXPECT_EQ(one.corners, four.corners);
  EXPECT_TRUE(one.points == four.points);
}

TEST(overlay_regions, one_site_has_all_of_the_regions) {
  const CellSet cell = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}}));
  const CellRings regions = random_regions(50, 2, 15);
  const CellRings clipped = clip(cell, CellSet::polygons(regions));
  EXPECT_NEAR(areas(clipped)[0], sum(areas(regions)), 1e-13);
}

// Neither covers the sphere: pieces are those of a cover's cells, with as many corners.
TEST(overlay_regions, parts_of_the_sphere) {
  const CellRings all = CellSet::voronoi(triangulation_of("uniform", 900, 17)).rings();
  const CellRings of_regions = random_regions(400, 3, 18);
  std::vector<Index> names(all.num_cells(), no_index);
  Index num_names = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i % 3 != 0) names[i] = num_names++;
  }
  const CellRings some = dissolve(all, names, num_names);
  const CellSet cells = CellSet::polygons(some);
  const CellSet regions = CellSet::polygons(of_regions);
  ASSERT_FALSE(cells.covers_sphere() || regions.covers_sphere());
  const RegionPieces expected = intersection(CellSet::polygons(all), regions);
  const std::vector<double> known = areas(expected.rings);
  for (const bool is_back : {false, true}) {
    const RegionPieces found =
        is_back ? intersection(regions, cells) : intersection(cells, regions);
    const std::vector<double> of_pieces = areas(found.rings);
    expect_simple_rings(found.rings);
    std::map<std::pair<Index, Index>, std::size_t> pieces;
    for (std::size_t k = 0; k < found.num_pieces(); ++k) {
      pieces[{is_back ? found.regions[k] : found.cells[k],
              is_back ? found.cells[k] : found.regions[k]}] = k;
    }
    for (std::size_t k = 0; k < known.size(); ++k) {
      const Index name = names[expected.cells[k]];
      if (name == no_index) continue;
      const auto piece = pieces.find({name, expected.regions[k]});
      ASSERT_NE(piece, pieces.end());
      EXPECT_NEAR(of_pieces[piece->second], known[k], 1e-15);
      EXPECT_EQ(num_corners_of(found.rings, piece->second), num_corners_of(expected.rings, k));
      pieces.erase(piece);
    }
    EXPECT_TRUE(pieces.empty());
  }
  EXPECT_NEAR(sum(areas(clip(cells, regions))), sum(areas(clip(regions, cells))), 1e-13);
}

// Corners of one that lie on sides of others stay; sides through the ends of the axes get a corner there.
TEST(overlay_regions, of_parts_that_overlap) {
  const auto boxes = [](const std::vector<std::array<double, 4>>& bounds) {
    CellRings cells;
    for (const auto& [west, south, east, north] : bounds) {
      for (const LonLat corner :
           {LonLat{west, south}, LonLat{east, south}, LonLat{east, north}, LonLat{west, north}}) {
        cells.corners.push_back(static_cast<Index>(cells.points.size()));
        cells.points.push_back(unit_vector(corner));
      }
      cells.rings.push_back(cells.corners.size());
      cells.cells.push_back(cells.rings.size() - 1);
    }
    return cells;
  };
  const CellSet twice = CellSet::polygons(boxes({{0, 0, 20, 20}, {10, 10, 30, 30}}));
  const CellSet plain =
      CellSet::polygons(boxes({{8, 8, 12, 12}, {20, 20, 25, 25}, {12, 8, 19, 12}}));
  for (const auto& [cells, regions] : {std::pair(twice, plain), std::pair(plain, twice)}) {
    const RegionPieces pieces = intersection(cells, regions);
    const std::vector<double> found = areas(pieces.rings);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const auto alone = [](const CellSet& all, Index i) {
        std::vector<Index> groups(all.num_cells(), no_index);
        groups[i] = 0;
        return CellSet::polygons(dissolve(all.rings(), groups, 1));
      };
      const Remap piece = remap(alone(cells, pieces.cells[k]), alone(regions, pieces.regions[k]));
      EXPECT_NEAR(found[k], piece_of(piece, 0, 0), 1e-15);
    }
  }
  // What is in any of them, once.
  const CellRings outline = clip(CellSet::polygons(boxes({{-5, -5, 40, 40}})), twice);
  expect_simple_rings(outline);
  EXPECT_EQ(outline.corners.size(), 8U);
  const double shared = areas(intersection(CellSet::polygons(boxes({{0, 0, 20, 20}})),
                                           CellSet::polygons(boxes({{10, 10, 30, 30}})))
                                  .rings)[0];
  EXPECT_NEAR(areas(outline)[0], sum(twice.areas()) - shared, 1e-15);
  const CellSet crossed =
      CellSet::polygons(boxes({{0, 0, 10, 10}, {5, -5, 8, 20}, {2, 3, 5, 9}, {-3, 4, 20, 6}}));
  const CellRings cross = clip(CellSet::voronoi(triangulation_of("uniform", 9, 3)), crossed);
  expect_simple_rings(cross);
  const Remap places = remap(crossed, CellSet::voronoi(triangulation_of("uniform", 9, 3)),
                             {.overlap = CellOverlap::first});
  EXPECT_NEAR(sum(areas(cross)), sum(places.areas), 1e-14);
  const CellSet around = CellSet::polygons(boxes({{-40, -30, 50, 40}}));
  const CellRings same = clip(plain, around);
  EXPECT_EQ(same.corners.size(), 12U);
  EXPECT_NEAR(sum(areas(same)), sum(plain.areas()), 1e-15);
  EXPECT_TRUE(clip(plain, CellSet::polygons(boxes({{100, 0, 120, 20}}))).corners.empty());
}

TEST(overlay_regions, bad_groups_are_refused) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 10, 16));
  const CellRings rings = cells.rings();
  EXPECT_THROW(dissolve(rings, std::vector<Index>(9, 0), 1), InvalidInput);
  std::vector<Index> groups(10, 0);
  groups[7] = 1;
  try {
    (void)dissolve(rings, groups, 1);
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "cell 7 is of group 1 of 1");
    EXPECT_EQ(error.index(), 7U);
  }
}

}  // namespace
}  // namespace rondel::test
