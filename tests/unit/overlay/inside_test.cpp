// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions for which the generators of hostile shapes have found something, and others of their kinds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/shapes.h"
#include "unit/overlay/support.h"
#include "unit/overlay/trial.h"

namespace rondel::test {
namespace {

std::size_t number_of_kind(std::string_view name) {
  const auto there = std::ranges::find(shape_kinds, name);
  return static_cast<std::size_t>(there - shape_kinds.begin());
}

void expect_right(const std::vector<RingOfPoints>& rings, std::uint64_t set) {
  const Trial trial(rings, false);
  if (!trial.is_wrong()) trial.expect_areas();
  for (const Cover& cover : known_covers(set)) {
    SCOPED_TRACE(cover.name);
    for (std::uint64_t way = 0; way < 6; way += 3) trial.expect_pieces(cover, way);
  }
}

// A loop that the ring passes at a corner, sides that end on a parallel, what is left of folds, islands on a parallel.
TEST(overlay_inside, seeds_that_failed) {
  const std::vector<std::pair<const char*, std::uint64_t>> seeds = {
      {"octant", 23},   {"octant", 56398}, {"cap", 29},      {"cap", 650},
      {"cap", 61},      {"folded", 28},    {"folded", 869},  {"folded", 917},
      {"folded", 2727},

      {"islands", 0},   {"islands", 12},   {"keyhole", 76},  {"lagoon", 24708},
      {"belt", 188},    {"belt", 302},     {"belt", 474},    {"belt", 725},
      {"sliver", 6},    {"tangle", 38},    {"bow_tie", 428}, {"world_less_islands", 428}};
  for (const auto& [kind, seed] : seeds) {
    SCOPED_TRACE(std::string(kind) + ' ' + std::to_string(seed));
    const std::vector<Cover>& covers = known_covers(seed % num_cover_sets);
    expect_right(hostile_shape(number_of_kind(kind), seed, corners_of(covers[seed % 3])),
                 seed % num_cover_sets);
  }
}

// Regions that are as far around the sphere on one side as on the other.
TEST(overlay_inside, the_center_of_mass_is_that_of_the_sphere) {
  const auto square = [](double height, bool is_clockwise) {
    const double radius = std::sqrt((1 - height) * (1 + height));
    RingOfPoints ring = {
        {-radius, 0, height}, {0, -radius, height}, {radius, 0, height}, {0, radius, height}};
    if (is_clockwise) std::ranges::reverse(ring);
    return ring;
  };
  for (const double height : {0.5, 1e-2, 1e-7, 1.9419565629710794e-08, 1e-9, 1e-12}) {
    SCOPED_TRACE(height);
    expect_right({square(0, false), square(height, true)}, 0);
    expect_right({square(-height, false), square(height, true)}, 1);
    RingOfPoints triangle = {{1, -height, -height}, {1, height, -height}, {1, 0, height}};
    RingOfPoints opposite = {{-1, 0, -height}, {-1, height, height}, {-1, -height, height}};
    for (RingOfPoints* ring : {&triangle, &opposite}) {
      for (Point& p : *ring) p = normalized(p);
    }
    expect_right({triangle, opposite}, 2);
  }
}

// Two loops of one size, one of them clockwise, where a side passes a corner of the other one.
// Two loops of one area turn in opposite directions: together they have an area near 0, more or less than its rounding.
TEST(overlay_inside, loops_that_balance_are_refused) {
  constexpr double size = 0x1p-10;
  for (const double more : {0.0, 1e-16, -1e-16, 1e-14, -1e-14, 1e-12}) {
    SCOPED_TRACE(more);
    const double w = size * (1 + more / (size * size));
    const auto at = [](double x, double y) { return normalized(Point{1, x, y}); };
    CellRings cells;
    cells.points = {at(-size, -size), at(w, w), at(w, -w), at(-size, size)};
    cells.corners = {0, 1, 2, 3};
    cells.rings = {0, 4};
    cells.cells = {0, 1};
    for (const Cover& cover : known_covers(0)) {
      SCOPED_TRACE(cover.name);
      EXPECT_THROW((void)remap(CellSet::polygons(cells), cover.cells), InvalidInput);
    }
    // The loops now have a corner where they meet.
    cells.points.push_back({1, 0, 0});
    cells.corners = {0, 4, 1, 2, 4, 3};
    cells.rings = {0, 6};
    for (const Cover& cover : known_covers(0)) {
      SCOPED_TRACE(cover.name);
      EXPECT_THROW((void)remap(CellSet::polygons(cells), cover.cells), InvalidInput);
    }
  }
}

TEST(overlay_inside, a_loop_at_a_corner_on_a_side_is_refused) {
  for (const double share : {0.1, 0.5, 0.9}) {
    const Point beyond = {-share, -std::sqrt(1 - share * share), 0};
    const RingOfPoints ring = {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}, beyond, {-1, 0, 0}, {0, 0, -1}};
    const CellSet cell = CellSet::polygons(one_cell_of({ring}));
    EXPECT_EQ(overlapping_cells(one_cell_of({ring})).size(), 1U);
    for (const Cover& cover : known_covers(1)) {
      EXPECT_THROW((void)remap(cell, cover.cells), InvalidInput) << cover.name;
      EXPECT_THROW((void)remap(cover.cells, cell), InvalidInput) << cover.name;
    }
  }
}

// A side goes north of the parallel on which it ends, and comes back to it.
TEST(overlay_inside, sides_that_end_on_a_parallel) {
  for (const double lat : {45.0, -45.0, 60.0}) {
    const LonLatGrid grid = {{-180, -60, 60, 180}, {-90, -60, -45, 0, 45, 60, 90}};
    const CellSet boxes = CellSet::lonlat_grid(grid);
    for (const double lon : {10.0, 40.0, 100.0}) {
      const double sign = lat > 0 ? 1 : -1;
      const RingOfPoints ring = {unit_vector({0, lat}), unit_vector({lon / 2, lat - sign * 60}),
                                 unit_vector({lon, lat - sign * 3})};
      const RegionOracle oracle({ring});
      const Remap pieces = remap(CellSet::polygons(one_cell_of({ring})), boxes);
      for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
          const OracleBox box = {grid.lon_deg[column], grid.lat_deg[row], grid.lon_deg[column + 1],
                                 grid.lat_deg[row + 1]};
          EXPECT_NEAR(piece_of(pieces, 0, 3 * row + column), oracle.piece(box, true).area, 1e-14)
              << lat << ' ' << lon << ' ' << row << ' ' << column;
        }
      }
    }
  }
}

// Pieces of a cell that is smaller than what a row of the grid is high.
TEST(overlay_inside, small_cells_on_a_parallel_keep_their_pieces) {
  const CellSet boxes = CellSet::lonlat_grid({{-180, 0, 180}, {-90, 30, 90}});
  for (const double size : {1e-2, 1e-5, 1e-8}) {
    const Point p = unit_vector({40, 30});
    const Point east = unit_vector({130, 0});
    const Point north = unit_vector({-140, 60});
    RingOfPoints ring;
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      ring.push_back(normalized(p + x * size * east + y * size * north));
    }
    const RegionOracle oracle({ring});
    const Remap pieces = remap(CellSet::polygons(one_cell_of({ring})), boxes);
    EXPECT_NEAR(piece_of(pieces, 0, 1), oracle.piece(OracleBox{0, -90, 180, 30}, true).area,
                1e-14 * size);
    EXPECT_NEAR(piece_of(pieces, 0, 3), oracle.piece(OracleBox{0, 30, 180, 90}, true).area,
                1e-14 * size);
    EXPECT_GT(piece_of(pieces, 0, 1), 0);
  }
}

// A ring and a hole that is as large, or two halves of the sphere: nobody knows which.
TEST(overlay_inside, sides_that_all_run_to_and_fro_are_refused) {
  const RingOfPoints ring = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  RingOfPoints back = ring;
  std::ranges::reverse(back);
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return CellSet::polygons(one_cell_of({ring, back}));
            }),
            "cell 0 has all of its sides in both directions: it is nothing, or the whole sphere, "
            "which has no rings");
  // What has no width is nothing.
  EXPECT_EQ(
      CellSet::polygons(one_cell_of({{ring[0], ring[1], normalized(Point{1, 1, 0})}})).areas()[0],
      0);
}

// The border of a cell is next to that of a half of the sphere.
TEST(overlay_inside, rings_within_rounding_of_a_half) {
  const CellSet halves = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}, {0, 0, -1}}));
  for (const double height : {1e-300, 1e-20, 1e-17, 1e-16, 1e-12, 1e-6, 1e-3, 0.1}) {
    for (const double side : {1.0, -1.0}) {
      RingOfPoints ring;
      for (int k = 0; k < 12; ++k) {
        const double angle = side * (k + 0.3) * std::numbers::pi / 6;
        ring.push_back({std::cos(angle), std::sin(angle), side * height});
      }
      for (Point& p : ring) p = normalized(p);
      for (const bool is_turned : {false, true}) {
        if (is_turned) std::ranges::reverse(ring);
        const CellSet cell = CellSet::polygons(one_cell_of({ring}));
        const Remap pieces = remap(cell, halves);
        const double sum = pieces.areas.empty()
                               ? 0
                               : std::accumulate(pieces.areas.begin(), pieces.areas.end(), 0.0);
        EXPECT_NEAR(sum, cell.areas()[0], 1e-12) << height << ' ' << side << ' ' << is_turned;
        EXPECT_NEAR(cell.areas()[0], RegionOracle({ring}).area(true).area, 1e-12);
      }
    }
  }
}

// With arcs for sides, a spike at the westernmost corner does not tell which way a ring goes.
TEST(overlay_inside, a_spike_at_the_westernmost_corner) {
  for (const double lat : {-3.0, 2.0, 9.0}) {
    RingInPlane ring = {{0, 0}, {3, lat}, {0, 0}, {10, -1}, {10, 5}};
    const double plain = 0.5 * 10 * 6 * std::pow(std::numbers::pi / 180, 2);
    for (const bool is_turned : {false, true}) {
      if (is_turned) std::ranges::reverse(ring);
      const CellTable table =
          planar_table({{planar_polygon({ring})}}, {.edges = PolygonEdges::geodesic});
      EXPECT_NEAR(areas(table.cells)[0], plain, 0.01 * plain) << lat;
    }
  }
}

// Around the whole sphere, however narrow.
TEST(overlay_inside, belts_have_their_areas) {
  for (const double lat : {0.0, 20.0, 70.0}) {
    for (const double width : {1e-3, 1e-6, 1e-9, 1e-11}) {
      RingOfPoints south;
      RingOfPoints north;
      for (int lon = 0; lon < 360; lon += 15) {
        south.push_back(unit_vector({static_cast<double>(lon), lat}));
        north.push_back(unit_vector({static_cast<double>(lon), lat + width}));
      }
      std::ranges::reverse(north);
      expect_right({south, north}, 2);
      EXPECT_GT(CellSet::polygons(one_cell_of({south, north})).areas()[0], 0)
          << lat << ' ' << width;
    }
  }
}

// Rows at a pole in great circles, of which the widest ones have all of their corners on one.
TEST(overlay_inside, polar_rows_in_great_circles) {
  for (const double width : {90.0, 120.0, 179.0, 179.999999, 180.0}) {
    for (const double south : {60.0, 80.0, 89.0}) {
      for (double west = -180; west < 180; west += 90) {
        const RingOfPoints top = {
            unit_vector({west, south}), unit_vector({west + width, south}), {0, 0, 1}};
        expect_right({top}, 0);
        const RingOfPoints below = {unit_vector({west, south - 10}),
                                    unit_vector({west + width, south - 10}), top[1], top[0]};
        expect_right({below}, 0);
      }
    }
  }
}

// The inside of hostile regions is found for cells of every kind. The oracle computes winding
// numbers of rings with 77 digits (oracle.h): either pieces are correct up to rounding, or
// it agrees that the rings bound nothing. RONDEL_TEST_SCALE multiplies the number of regions.

class OverlayInside : public testing::TestWithParam<std::size_t> {};

TEST_P(OverlayInside, pieces_are_those_of_winding_numbers) {
  constexpr std::uint64_t audited_every = 64;
  const std::size_t num_shapes = scaled(10);
  std::size_t num_wrong = 0;
  for (std::uint64_t seed = 0; seed < num_shapes; ++seed) {
    SCOPED_TRACE(std::string(shape_kinds.at(GetParam())) + ' ' + std::to_string(seed));
    const std::vector<Cover>& covers = known_covers(seed % num_cover_sets);
    const std::vector<RingOfPoints> rings =
        hostile_shape(GetParam(), seed, corners_of(covers[seed % 3]));
    Trial trial(rings, seed % audited_every == 7);
    if (trial.is_wrong()) {
      ++num_wrong;
    } else {
      trial.expect_areas();
    }
    for (const Cover& cover : covers) {
      SCOPED_TRACE(cover.name);
      trial.expect_pieces(cover, seed);
    }
    constexpr int max_failures = 30;
    if (testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count() >
        max_failures)
      break;
  }
  RecordProperty("wrong", static_cast<int>(num_wrong));
}

INSTANTIATE_TEST_SUITE_P(overlay, OverlayInside, testing::Range(std::size_t{0}, shape_kinds.size()),
                         [](const auto& test) { return shape_kinds.at(test.param); });

}  // namespace
}  // namespace rondel::test
