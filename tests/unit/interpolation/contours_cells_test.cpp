// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Contours in the cells of meshes: those of a triangulation where the cells are its faces, segments
// and areas that are computed cell by cell where some are missing, and values of native_weights().

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/contours.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/named_grids.h"
#include "rondel/native_weights.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::vector<Point> random_sites(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> sites;
  while (sites.size() < n) {
    const Point p = random.in_cube();
    if (dot(p, p) > 0.1 && dot(p, p) < 1) sites.push_back(normalized(p));
  }
  return sites;
}

std::vector<double> wavy(const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& p : points) {
    values.push_back(std::sin(5 * p.x) + std::cos(4 * p.y) * p.z + 0.3 * p.z);
  }
  return values;
}

// Returns some of the faces as cells, every other one in the other direction.
CellRings cells_of(const std::vector<Point>& points, std::span<const Triple> faces,
                   std::size_t but) {
  CellRings cells;
  cells.points = points;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto [a, b, c] = faces[f];
    if (f % 2 == 1) std::swap(b, c);
    const Index ring[] = {a, b, c};
    if (but == 0 || f % but != 0) cells.append_ring(ring);
    cells.end_cell();
  }
  return cells;
}

TEST(contours_in_cells, of_all_faces_are_those_of_the_triangulation) {
  const std::vector<Point> sites = random_sites(700, 5);
  const Triangulation triangulation = delaunay(Sites(sites));
  std::vector<double> values = wavy(sites);
  const CellRings cells = cells_of(sites, triangulation.faces(), 0);
  for (const bool has_gaps : {false, true}) {
    if (has_gaps) values[17] = values[300] = no_value;
    // A level that some values have, too.
    const std::vector<double> levels = {-0.8, values[40], 0.9};
    const Isolines wanted = isolines(triangulation, values, levels);
    const Isolines found = isolines(cells, values, levels);
    EXPECT_EQ(found.lines.rows.values, wanted.lines.rows.values);
    EXPECT_EQ(found.lines.rows.offsets, wanted.lines.rows.offsets);
    EXPECT_EQ(found.lines.offsets, wanted.lines.offsets);
    EXPECT_EQ(found.is_closed, wanted.is_closed);
    EXPECT_GT(found.num_lines(), 3U);
    const Bands wanted_bands = bands(triangulation, values, levels);
    const Bands found_bands = bands(cells, values, levels);
    EXPECT_EQ(found_bands.rings().values, wanted_bands.rings().values);
    EXPECT_EQ(found_bands.rings().offsets, wanted_bands.rings().offsets);
    EXPECT_EQ(found_bands.bands.rows.offsets, wanted_bands.bands.rows.offsets);
    EXPECT_EQ(found_bands.bands.offsets, wanted_bands.bands.offsets);
  }
}

// Points that differ by rounding alone have one key.
using PointKey = std::tuple<long, long, long>;
PointKey key_of(const Point& p) {
  return {std::lround(p.x * 1e12), std::lround(p.y * 1e12), std::lround(p.z * 1e12)};
}
using Segment = std::pair<PointKey, PointKey>;
Segment segment_of(const Point& a, const Point& b) { return std::minmax({key_of(a), key_of(b)}); }

// Where a quarter of the triangles are missing, a line has one segment in each other triangle that it
// crosses, and no more.
TEST(contours_in_cells, lines_end_where_cells_do) {
  const std::vector<Point> sites = random_sites(600, 9);
  const Triangulation triangulation = delaunay(Sites(sites));
  const std::vector<double> values = wavy(sites);
  const CellRings cells = cells_of(sites, triangulation.faces(), 4);
  const double level = 0.2501;
  const double levels[] = {level};
  std::multiset<Segment> wanted;
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    if (cells.cells[cell] == cells.cells[cell + 1]) continue;
    const auto ring = cells.corners_of(cells.cells[cell]);
    std::vector<Point> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      Index low = ring[k];
      Index high = ring[(k + 1) % 3];
      if (values[low] > values[high]) std::swap(low, high);
      if (!(values[low] < level && level < values[high])) continue;
      const double share = (level - values[low]) / (values[high] - values[low]);
      const Point from = normalized(sites[low]);
      ends.push_back(normalized(from + share * (normalized(sites[high]) - from)));
    }
    if (!ends.empty()) wanted.insert(segment_of(ends.at(0), ends.at(1)));
  }
  const Isolines found = isolines(cells, values, levels);
  std::multiset<Segment> segments;
  int num_open = 0;
  for (std::size_t line = 0; line < found.num_lines(); ++line) {
    const auto points = found.lines.rows[line];
    for (std::size_t k = 1; k < points.size(); ++k) {
      segments.insert(segment_of(points[k - 1], points[k]));
    }
    if (found.is_closed[line] != 0) segments.insert(segment_of(points.front(), points.back()));
    num_open += found.is_closed[line] == 0 ? 1 : 0;
  }
  EXPECT_EQ(segments, wanted);
  EXPECT_GT(wanted.size(), 100U);
  EXPECT_GT(num_open, 10);
}

// Returns the area to the left of a ring of short sides, about its first point.
double area_of(std::span<const Point> ring) {
  double area = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    area += exact::triangle_area(ring[0], ring[k], ring[k + 1]);
  }
  return area;
}

TEST(contours_in_cells, bands_have_the_area_of_the_cells) {
  // Cells of a part of the sphere, so that rings are no wider than a hemisphere.
  const CellRings all = NamedGrid("hexagons:R3B2").cells().rings();
  CellRings cells;
  cells.points = all.points;
  double wanted = 0;
  for (std::size_t cell = 0; cell < all.num_cells(); ++cell) {
    const auto ring = all.corners_of(all.cells[cell]);
    const bool is_near = std::ranges::all_of(ring, [&](Index i) { return all.points[i].x > 0.3; });
    if (!is_near || cell % 7 == 3) continue;
    std::vector<Point> corners;
    for (const Index i : ring) corners.push_back(all.points[i]);
    wanted += area_of(corners);
    cells.append_ring(std::vector<Index>(ring.begin(), ring.end()));
    cells.end_cell();
  }
  const std::vector<double> values = wavy(cells.points);
  const std::vector<double> levels = {-0.5, 0, 0.5, 1};
  const Bands found = bands(cells, values, levels);
  double area = 0;
  const auto& rings = found.rings();
  for (std::size_t ring = 0; ring < rings.size(); ++ring) area += area_of(rings[ring]);
  EXPECT_NEAR(area, wanted, 1e-13);
  EXPECT_GT(found.num_polygons(), 5U);
}

// On sides of cells lines are where native_weights() gives the level; at the lines from corners to
// middles they differ by the second order of the cells' size.
TEST(contours_in_cells, lines_are_where_native_weights_have_the_level) {
  const CellRings cells = NamedGrid("C24").cells().rings();
  const std::vector<double> values = wavy(cells.points);
  const double levels[] = {0.1};
  const Isolines found = isolines(cells, values, levels);
  const std::vector<Point>& points = found.lines.rows.values;
  const Weights weights = native_weights(cells, points);
  int num_equal = 0;
  double worst = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double value = 0;
    for (std::uint64_t e = weights.offsets[k]; e < weights.offsets[k + 1]; ++e) {
      value += weights.values[e] * values[weights.columns[e]];
    }
    const double apart = std::abs(value - levels[0]);
    num_equal += apart < 1e-13 ? 1 : 0;
    worst = std::max(worst, apart);
  }
  EXPECT_GT(num_equal, static_cast<int>(points.size() / 3));
  EXPECT_LT(num_equal, static_cast<int>(points.size()));
  EXPECT_LT(worst, 0.01);  // cells are 0.065 wide, second derivatives up to 25
  EXPECT_GE(found.num_lines(), 1U);
}

TEST(contours_in_cells, points_in_one_place_are_one) {
  const CellRings cells = NamedGrid("C6").cells().rings();
  CellRings apart;  // each cell with points of its own
  std::vector<double> values;
  const std::vector<double> united = wavy(cells.points);
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    std::vector<Index> ring;
    for (const Index i : cells.corners_of(cells.cells[cell])) {
      ring.push_back(static_cast<Index>(apart.points.size()));
      apart.points.push_back(cells.points[i]);
      // The first value at a place counts, also where it is not that of its first point.
      values.push_back(cell % 2 == 0 || std::ranges::count(apart.points, cells.points[i]) > 2
                           ? united[i]
                           : no_value);
    }
    apart.append_ring(ring);
    apart.end_cell();
  }
  const std::vector<double> levels = {0, 0.5};
  EXPECT_EQ(isolines(apart, values, levels).lines.rows.values,
            isolines(cells, united, levels).lines.rows.values);
  EXPECT_EQ(bands(apart, values, levels).rings().values,
            bands(cells, united, levels).rings().values);
}

TEST(contours_in_cells, a_sphere_without_lines_is_one_polygon_without_rings) {
  CellRings cells = NamedGrid("C3").cells().rings();
  const std::vector<double> values(cells.points.size(), 7);
  const std::vector<double> levels = {5};
  const Bands whole = bands(cells, values, levels);
  EXPECT_EQ(whole.num_polygons(), 1U);
  EXPECT_EQ(whole.rings().size(), 0U);
  CellRings some;
  some.points = cells.points;
  for (std::size_t cell = 1; cell < cells.num_cells(); ++cell) {
    some.append_rings(cells, cell);
    some.end_cell();
  }
  const Bands open = bands(some, values, levels);
  EXPECT_EQ(open.num_polygons(), 1U);
  EXPECT_EQ(open.rings().size(), 1U);
  EXPECT_EQ(open.rings()[0].size(), 4U);
  EXPECT_EQ(isolines(CellRings{}, {}, levels).num_lines(), 0U);
}

TEST(contours_in_cells, what_is_no_mesh_is_refused) {
  const auto why = [](const std::vector<LonLat>& places,
                      const std::vector<std::vector<Index>>& rings, std::vector<double> values) {
    CellRings cells;
    cells.points = unit_vectors(places);
    for (const std::vector<Index>& ring : rings) {
      cells.append_ring(ring);
      cells.end_cell();
    }
    const double levels[] = {0.5};
    return thrown_message<InvalidInput>([&] { return isolines(cells, values, levels); });
  };
  const std::vector<LonLat> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {5, 2}};
  const std::vector<double> values = {0, 1, 0, 1, 2};
  EXPECT_EQ(why(square, {{0, 1, 2}}, {0, 1}), "there are 2 values for 5 points");
  EXPECT_EQ(why(square, {{0, 1, 2}, {0, 1, 3}}, values),
            "cells overlap: two are on the same side of the arc between the points 0 and 1");
  EXPECT_EQ(why({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {9, 5}, {8, 1}}, {{0, 5, 1, 2, 4, 3}},
                {0, 1, 0, 1, 2, 1}),
            "cell 0 is not seen whole from the middle of its corners");
  EXPECT_EQ(why(square, {{0, 1, 2}}, {0, 1, HUGE_VAL, 0, 0}), "value 2 is infinite");
}

}  // namespace
}  // namespace rondel::test
