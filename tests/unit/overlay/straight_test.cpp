// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons whose sides are straight in longitude and latitude, in grids of meridians and parallels: against integrals
// along the sides of polygons that were clipped in the plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "overlay/cell_set_data.h"
#include "overlay/grid_pieces.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/tiled_remap.h"
#include "unit/overlay/grid_oracle.h"

namespace rondel::test {
namespace {

using LonLats = std::vector<LonLat>;

LonLats box_ring(double west, double south, double east, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

// Returns features of one polygon each, without holes.
CellSet features_of(const std::vector<LonLats>& rings, const PolygonOptions& options = {}) {
  LonLatMultiPolygons features;
  for (LonLats ring : rings) {
    ring.push_back(ring.front());
    features.rows.rows.append(ring);
    features.rows.end_group();
    features.end_group();
  }
  return CellSet::of(cells_of_polygons(features, options));
}

struct PlanePlace {
  long double lon;
  long double lat;
};

// Returns what of a ring is where a coordinate is below or above a line.
std::vector<PlanePlace> clipped_at(const std::vector<PlanePlace>& ring,
                                   long double PlanePlace::*along, long double line,
                                   bool is_above) {
  std::vector<PlanePlace> result;
  const auto beyond = [&](const PlanePlace& p) {
    return is_above ? p.*along - line : line - p.*along;
  };
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const PlanePlace& p = ring[k];
    const PlanePlace& q = ring[(k + 1) % ring.size()];
    if (beyond(p) >= 0) result.push_back(p);
    if ((beyond(p) > 0 && beyond(q) < 0) || (beyond(p) < 0 && beyond(q) > 0)) {
      const long double t = beyond(p) / (beyond(p) - beyond(q));
      result.push_back({p.lon + t * (q.lon - p.lon), p.lat + t * (q.lat - p.lat)});
    }
  }
  return result;
}

// Returns minus the integral of f(lon, lat) along a ring by longitude.
long double integral_along(const std::vector<PlanePlace>& ring,
                           const std::function<long double(long double, long double)>& f) {
  constexpr int steps = 24;  // of Gauss's quadrature with 5 points
  const long double root = 2 * std::sqrt(10.0L / 7);
  const long double of_weight = 13 * std::sqrt(70.0L);
  const std::array<std::pair<long double, long double>, 3> points = {
      {{0.0L, 64.0L / 225},
       {std::sqrt(5 - root) / 3, (322 + of_weight) / 1800},
       {std::sqrt(5 + root) / 3, (322 - of_weight) / 1800}}};
  long double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const PlanePlace& p = ring[k];
    const PlanePlace& q = ring[(k + 1) % ring.size()];
    const auto at = [&](long double t) {
      return f(p.lon + t * (q.lon - p.lon), p.lat + t * (q.lat - p.lat));
    };
    for (int s = 0; s < steps; ++s) {
      for (const auto& [place, weight] : points) {
        const long double middle = s + 0.5L;
        const long double one = at((middle - place / 2) / steps);
        const long double other = place > 0 ? at((middle + place / 2) / steps) : 0;
        sum -= (q.lon - p.lon) / steps * weight * (one + other);
      }
    }
  }
  return sum;
}

struct ExpectedPiece {
  long double area = 0;
  LongVector moment{};
};

// Returns the part of a ring in a box, also of the ring a turn to the west or east.
ExpectedPiece piece_in(const LonLats& ring, const LonLatBox& box) {
  ExpectedPiece piece;
  for (const int turn : {-1, 0, 1}) {
    std::vector<PlanePlace> part;
    for (const LonLat& p : ring) {
      part.push_back({(p.lon_deg + 360.0L * turn) * half_turn / 180, p.lat_deg * half_turn / 180});
    }
    part = clipped_at(part, &PlanePlace::lon, box.west, true);
    part = clipped_at(part, &PlanePlace::lon, box.east, false);
    part = clipped_at(part, &PlanePlace::lat, box.south, true);
    part = clipped_at(part, &PlanePlace::lat, box.north, false);
    const auto outward = [](long double lat) { return lat / 2 + std::sin(2 * lat) / 4; };
    piece.area += integral_along(part, [](auto, auto lat) { return std::sin(lat); });
    piece.moment.x +=
        integral_along(part, [&](auto lon, auto lat) { return outward(lat) * std::cos(lon); });
    piece.moment.y +=
        integral_along(part, [&](auto lon, auto lat) { return outward(lat) * std::sin(lon); });
    piece.moment.z +=
        integral_along(part, [](auto, auto lat) { return std::sin(lat) * std::sin(lat) / 2; });
  }
  return piece;
}

// The largest difference of a piece, and of its moment, from the integrals.
double worst_difference(const std::vector<LonLats>& rings, const LonLatGrid& lines) {
  const CellSet cells = features_of(rings);
  const overlay::PreparedGrid grid(lines);
  const overlay::PieceRows found = overlay::pieces(overlay::CellSetData::of(cells), grid, true, {});
  long double worst = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    std::uint64_t k = found.offsets[i];
    for (Index box = 0; box < grid.num_cells(); ++box) {
      const bool is_found = k < found.offsets[i + 1] && found.columns[k] == box;
      const ExpectedPiece expected = piece_in(rings[i], box_of(lines, box));
      const Point moment = is_found ? found.moments[k] : Point{};
      const double area = is_found ? found.areas[k] : 0;
      worst = std::max(
          {worst, std::abs(area - expected.area), std::abs(moment.x - expected.moment.x),
           std::abs(moment.y - expected.moment.y), std::abs(moment.z - expected.moment.z)});
      k += is_found ? 1 : 0;
    }
    EXPECT_EQ(k, found.offsets[i + 1]);
  }
  return static_cast<double>(worst);
}

// Returns a polygon of slanted sides around a middle.
LonLats star(std::mt19937& random, const LonLat& middle, double radius) {
  std::uniform_real_distribution<double> share(0.3, 1);
  LonLats ring;
  constexpr int corners = 11;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    const double reach = radius * share(random);
    ring.push_back(
        {middle.lon_deg + reach * std::cos(angle), middle.lat_deg + reach * std::sin(angle)});
  }
  return ring;
}

TEST(overlay_straight, pieces_are_integrals_along_the_sides) {
  std::mt19937 random(5);
  std::vector<LonLats> rings;
  for (const LonLat& middle : {LonLat{10, 5}, {-100, 48}, {178, -62}, {-179, 71}, {60, 84.5}}) {
    rings.push_back(star(random, middle, 5));
  }
  EXPECT_LT(worst_difference(rings, regular_grid(36, 18)), 1e-15);
  EXPECT_LT(worst_difference(rings, regular_grid(90, 90, 3)), 1e-15);
  EXPECT_LT(worst_difference(rings, regular_grid(1, 1)), 1e-15);
  // Southward, and a region with some of the polygons.
  EXPECT_LT(worst_difference(rings, {{350, 355, 370}, {60, 40, 30, 4.5, 0}}), 1e-15);
}

TEST(overlay_straight, pieces_next_to_poles_and_around_them) {
  const std::vector<LonLats> rings = {
      box_ring(-180, 60, 180, 90),
      box_ring(-180, -90, 180, -89.5),
      box_ring(0, 89.999, 30, 90),
      {{0, 88.5}, {120, 89}, {240, 88.2}, {360, 88.5}, {360, 90}, {0, 90}},
      box_ring(-180, -10, 180, 15)};
  EXPECT_LT(worst_difference(rings, regular_grid(12, 18)), 4e-15);
  EXPECT_LT(worst_difference(rings, regular_grid(8, 720)), 4e-15);
  EXPECT_LT(worst_difference(rings, regular_grid(1, 2)), 8e-15);
  // The small cells next to the pole have a relative error of rounding.
  const Remap remap =
      rondel::remap(CellSet::lonlat_grid(regular_grid(12, 18)), features_of({rings[2]}));
  const long double half = std::sin((90 - 89.999) / 360 * half_turn);
  ASSERT_EQ(remap.areas.size(), 1U);
  EXPECT_NEAR(remap.areas[0] / static_cast<double>(half_turn / 3 * half * half), 1, 1e-14);
}

// A grid of 0.01 degrees, and boxes along its lines, of which arcs would touch the next row.
TEST(overlay_straight, boxes_along_cells_have_these_cells_alone) {
  LonLatGrid lines;
  for (int k = 0; k <= 400; ++k) lines.lon_deg.push_back(k * 0.01);
  for (int k = 0; k <= 20; ++k) lines.lat_deg.push_back(45 + k * 0.01);
  const CellSet grid = CellSet::lonlat_grid(lines);
  const auto expect_cells = [&](const LonLats& box, std::size_t first_row, std::size_t num_rows) {
    const Remap remap = rondel::remap(grid, features_of({box}));
    ASSERT_EQ(remap.areas.size(), num_rows * 400);
    for (std::size_t k = 0; k < remap.areas.size(); ++k) {
      EXPECT_EQ(remap.pieces.values[k], first_row * 400 + k);
      EXPECT_NEAR(remap.areas[k] / remap.source_areas[remap.pieces.values[k]], 1, 4 * ulp);
    }
    EXPECT_NEAR(remap.target_fractions[0], 1, 1e-15);
  };
  expect_cells(box_ring(0, 45, 4, 45.1), 0, 10);
  expect_cells(box_ring(0, 45.09, 4, 45.1), 9, 1);
  expect_cells(box_ring(-360, 45.09, -356, 45.1), 9, 1);
  expect_cells({{0, 45}, {1.5, 45}, {4, 45}, {4, 45.1}, {2.2, 45.1}, {0, 45.1}}, 0, 10);
  // Half of it is beyond the grid.
  const Remap half = rondel::remap(grid, features_of({box_ring(-4, 45, 4, 45.2)}));
  EXPECT_NEAR(half.target_fractions[0], 0.5, 1e-15);
}

// Polygons that overlap and touch, each of them with the bytes that it has alone.
TEST(overlay_straight, pieces_do_not_depend_on_other_polygons) {
  std::mt19937 random(8);
  std::vector<LonLats> rings = {box_ring(0, 45, 4, 45.1), box_ring(0.5, 44.95, 2, 45.1),
                                box_ring(2, 45.09, 3, 45.2), box_ring(1, 44, 3, 46)};
  for (int k = 0; k < 6; ++k) rings.push_back(star(random, {2, 45}, 1 + k));
  rings.insert(rings.begin() + 2, box_ring(-180, -90, 180, 90));  // the whole sphere
  const CellSet grid = CellSet::lonlat_grid(regular_grid(720, 360));
  const Remap all = remap(grid, features_of(rings), {.overlap = CellOverlap::each});
  for (std::size_t z = 0; z < rings.size(); ++z) {
    const Remap alone = remap(grid, features_of({rings[z]}));
    EXPECT_NEAR(all.target_areas[z] / alone.target_areas[0], 1, 1e-13) << z;
    const std::uint64_t begin = all.pieces.offsets[z];
    ASSERT_EQ(all.pieces.offsets[z + 1] - begin, alone.areas.size()) << z;
    for (std::size_t k = 0; k < alone.areas.size(); ++k) {
      EXPECT_EQ(all.pieces.values[begin + k], alone.pieces.values[k]);
      EXPECT_NEAR(all.areas[begin + k], alone.areas[k], 1e-17) << z << ' ' << k;
    }
  }
  EXPECT_EQ(all.pieces.offsets[3] - all.pieces.offsets[2], 720U * 360U);
  const auto mesh = CellSet::voronoi(triangulation_of("uniform", 100, 5));
  const Remap in_mesh = remap(mesh, features_of(rings), {.overlap = CellOverlap::each});
  for (std::size_t z = 0; z < rings.size(); ++z) {
    EXPECT_NEAR(in_mesh.target_fractions[z], 1, 1e-9) << z;
  }
}

// Targets in cells that are no grid have arcs; with `first` and `share` so do polygons that are cut.
TEST(overlay_straight, arcs_count_elsewhere) {
  const CellSet boxes = features_of({box_ring(0, 40, 40, 50), box_ring(20, 45, 60, 55)});
  const auto mesh = CellSet::voronoi(triangulation_of("uniform", 500, 5));
  const Remap in_mesh = remap(mesh, boxes, {.overlap = CellOverlap::each});
  for (std::size_t z = 0; z < 2; ++z) {
    EXPECT_NEAR(in_mesh.target_areas[z], boxes.areas()[z], 1e-14);
    EXPECT_NEAR(in_mesh.target_fractions[z], 1, 1e-14);
  }
  const CellSet grid = CellSet::lonlat_grid(regular_grid(36, 36));
  const auto sum = [&](CellOverlap rule) {
    const Remap found = remap(grid, boxes, {.overlap = rule});
    return found.target_areas[0] + found.target_areas[1];
  };
  EXPECT_NEAR(sum(CellOverlap::first), sum(CellOverlap::share), 1e-14);
  EXPECT_GT(sum(CellOverlap::each), 1.1 * sum(CellOverlap::share));
}

TEST(overlay_straight, tiles_have_the_rows_of_the_whole) {
  std::mt19937 random(9);
  std::vector<LonLats> rings = {box_ring(-180, 60, 180, 90), box_ring(0, -70, 90, -65)};
  for (const LonLat& middle : {LonLat{10, 5}, {-100, 48}, {178, -42}}) {
    rings.push_back(star(random, middle, 5));
  }
  const CellSet cells = features_of(rings);
  const LonLatGrid lines = regular_grid(72, 36);
  const CellSet grid = CellSet::lonlat_grid(lines);
  for (const bool is_target : {true, false}) {
    const Remap whole = is_target ? remap(grid, cells) : remap(cells, grid);
    const TiledRemap tiles =
        is_target ? TiledRemap(TiledCells(lines), TiledCells(cells), {.cells_per_tile = 700})
                  : TiledRemap(TiledCells(cells), TiledCells(lines), {.cells_per_tile = 700});
    ASSERT_GT(tiles.num_tiles(), 1U);
    for (std::size_t t = 0; t < tiles.num_tiles(); ++t) {
      const RemapTile tile = tiles.tile(t);
      for (std::size_t r = 0; r < tile.targets.size(); ++r) {
        const std::uint64_t begin = whole.weights.offsets[tile.targets[r]];
        const std::uint64_t first = tile.weights.offsets[r];
        ASSERT_EQ(tile.weights.offsets[r + 1] - first,
                  whole.weights.offsets[tile.targets[r] + std::size_t{1}] - begin);
        EXPECT_EQ(tile.areas[r], whole.target_areas[tile.targets[r]]);
        for (std::uint64_t k = first; k < tile.weights.offsets[r + 1]; ++k) {
          EXPECT_EQ(tile.weights.values[k], whole.weights.values[begin + k - first]);
        }
      }
    }
  }
}

// A field that is linear in space keeps its moments under the second order: conservation.
TEST(overlay_straight, second_order_conserves) {
  std::vector<LonLats> rings;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 6; ++j) {
      rings.push_back(box_ring(-180 + 30 * i, -90 + 30 * j, -150 + 30 * i, -60 + 30 * j));
    }
  }
  const CellSet cells = features_of(rings);
  const Remap back = remap(cells, CellSet::lonlat_grid(regular_grid(50, 25)), {.order = 2});
  std::vector<double> sums(rings.size());
  for (std::size_t j = 0; j < back.target_areas.size(); ++j) {
    for (std::uint64_t k = back.weights.offsets[j]; k < back.weights.offsets[j + 1]; ++k) {
      sums[back.weights.columns[k]] += back.weights.values[k] * back.target_areas[j];
    }
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    EXPECT_NEAR(sums[i], back.source_areas[i], 1e-14) << i;
  }
}

TEST(overlay_straight, sides_that_do_not_fit_are_refused) {
  const CellSet box = features_of({box_ring(0, 0, 10, 10)});
  const CellRings rings = box.given_rings();
  CompressedRows<LonLatSide> sides = box.sides();
  EXPECT_EQ(CellSet::polygons(rings, sides).sides(), sides);
  EXPECT_EQ(CellSet::polygons(rings).sides().size(), 0U);
  sides.values.front().from.lat_deg = 91;
  EXPECT_THROW(static_cast<void>(CellSet::polygons(rings, sides)), InvalidInput);
  sides = box.sides();
  sides.end_row();
  EXPECT_THROW(static_cast<void>(CellSet::polygons(rings, sides)), InvalidInput);
  // Geodesic sides are arcs, and what was repaired has arcs.
  EXPECT_EQ(features_of({box_ring(0, 0, 10, 10)}, {.edges = PolygonEdges::geodesic}).sides().size(),
            0U);
  const LonLats tie = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  const CellSet repaired =
      features_of({tie, box_ring(20, 0, 30, 10)}, {.invalid = InvalidPolygons::repair});
  ASSERT_EQ(repaired.sides().size(), 2U);
  EXPECT_TRUE(repaired.sides()[0].empty());
  EXPECT_EQ(repaired.sides()[1].size(), 4U);
}

}  // namespace
}  // namespace rondel::test
