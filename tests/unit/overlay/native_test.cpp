// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights in the cells of a mesh, against the formula of Wachspress in one plane for the whole cell, in
// 64 bits, against triangles of Interpolator, and against the contract.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/interpolate.h"
#include "rondel/native_weights.h"
#include "rondel/predicates.h"
#include "support/random.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

std::vector<Point> directions(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random.direction());
  return points;
}

CellRings voronoi_cells(std::size_t n, std::uint64_t seed) {
  return CellSet::voronoi(delaunay(directions(n, seed))).rings();
}

// Hexagons and twelve pentagons: the duals of the triangles of an icosahedron whose faces are divided.
CellRings hexagons() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Point> corners;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-golden, golden}) {
      corners.push_back({0, s, t});
      corners.push_back({s, t, 0});
      corners.push_back({t, 0, s});
    }
  }
  std::vector<Point> sites;
  const Triangulation coarse = delaunay(corners);
  constexpr int parts = 12;
  for (const auto& face : coarse.faces()) {
    for (int i = 0; i <= parts; ++i) {
      for (int j = 0; i + j <= parts; ++j) {
        const Point sum = static_cast<double>(i) * corners[face[0]] +
                          static_cast<double>(j) * corners[face[1]] +
                          static_cast<double>(parts - i - j) * corners[face[2]];
        const Point site = normalized(sum);
        const bool is_new = std::ranges::none_of(
            sites, [&](const Point& other) { return norm(site - other) < 1e-9; });
        if (is_new) sites.push_back(site);
      }
    }
  }
  return CellSet::voronoi(delaunay(sites)).rings();
}

CellRings ring_of(const std::vector<LonLat>& corners) {
  CellRings cells;
  cells.points = unit_vectors(corners);
  std::vector<Index> ring(corners.size());
  std::iota(ring.begin(), ring.end(), Index{0});
  cells.append_ring(ring);
  cells.end_cell();
  return cells;
}

struct NativeRow {
  std::span<const Index> columns;
  std::span<const double> values;
};
NativeRow row_of(const Weights& weights, std::size_t r) {
  const std::size_t begin = weights.offsets[r];
  const std::size_t size = weights.offsets[r + 1] - begin;
  return {std::span(weights.columns).subspan(begin, size),
          std::span(weights.values).subspan(begin, size)};
}

// Rules 2 and 4 for one row.
void expect_direction(const NativeRow& row, std::span<const Point> points, const Point& u) {
  double sum = 0;
  Point along{0, 0, 0};
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    sum += row.values[k];
    along = along + row.values[k] * points[row.columns[k]];
  }
  EXPECT_NEAR(sum, 1, 2e-15);
  const double r = dot(along, u);
  EXPECT_GT(r, 0);
  EXPECT_LT(r, 1 + 1e-15);
  EXPECT_LT(norm(along - r * u), 1e-14);
}

// Wachspress's weights in the plane that touches the sphere at `middle`, as polygons in the plane have
// them, and those of the corners' unit vectors that follow.
std::vector<long double> planar_wachspress(const std::vector<Point>& ring, const Point& middle,
                                           const Point& u) {
  struct Place {
    long double x, y, scale;
  };
  const Point axis = std::abs(middle.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point east = normalized(cross(axis, middle));
  const Point north = cross(middle, east);
  const auto dot_of = [](const Point& a, const Point& b) {
    return static_cast<long double>(a.x) * b.x + static_cast<long double>(a.y) * b.y +
           static_cast<long double>(a.z) * b.z;
  };
  const auto place_of = [&](const Point& p) {
    const long double scale = dot_of(p, middle);
    return Place{dot_of(p, east) / scale, dot_of(p, north) / scale, scale};
  };
  const auto area = [](const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  };
  std::vector<Place> places;
  for (const Point& corner : ring) places.push_back(place_of(corner));
  const Place at = place_of(u);
  const std::size_t n = places.size();
  std::vector<long double> weights(n);
  long double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Place& before = places[(k + n - 1) % n];
    const Place& after = places[(k + 1) % n];
    const long double planar =
        area(before, places[k], after) / (area(at, before, places[k]) * area(at, places[k], after));
    weights[k] = planar / places[k].scale;
    sum += weights[k];
  }
  for (long double& weight : weights) weight /= sum;
  return weights;
}

TEST(native, hexagons_reproduce_directions_and_corners) {
  const CellRings cells = hexagons();
  const std::vector<Point> targets = directions(20000, 7);
  const Weights weights = native_weights(cells, targets);
  ASSERT_EQ(weights.num_rows(), targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const NativeRow row = row_of(weights, t);
    ASSERT_GE(row.columns.size(), 5U);
    expect_direction(row, cells.points, normalized(targets[t]));
    for (const double value : row.values) EXPECT_GE(value, 0);
  }
  const Weights at_corners = native_weights(cells, cells.points);
  for (std::size_t t = 0; t < cells.points.size(); ++t) {
    const NativeRow row = row_of(at_corners, t);
    ASSERT_EQ(row.columns.size(), 1U);
    EXPECT_EQ(cells.points[row.columns[0]], cells.points[t]);
    EXPECT_EQ(row.values[0], 1);
  }
}

TEST(native, linear_fields_are_reproduced_within_1e_14_on_hexagons) {
  const CellRings cells = hexagons();
  const std::vector<Point> targets = directions(20000, 8);
  const Weights weights = native_weights(cells, targets);
  const Point g{0.3, -0.7, 0.2};
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const NativeRow row = row_of(weights, t);
    double value = 0;
    double r = 0;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      value += row.values[k] * (2 + dot(g, cells.points[row.columns[k]]));
      r += row.values[k] * dot(targets[t], cells.points[row.columns[k]]);
    }
    EXPECT_NEAR(value, 2 + r * dot(g, targets[t]), 1e-14);
  }
}

TEST(native, convex_cells_have_the_weights_of_wachspress) {
  const CellRings cells = hexagons();
  Random random(9);
  std::vector<Point> targets;
  std::vector<std::size_t> owners;
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    Point inside{0, 0, 0};
    for (const Index i : cells.corners_of(cells.cells[cell])) {
      inside = inside + (0.01 + random.unit()) * cells.points[i];
    }
    targets.push_back(normalized(inside));
    owners.push_back(cell);
  }
  const Weights weights = native_weights(cells, targets);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    std::vector<Point> ring;
    Point middle{0, 0, 0};
    const auto corners = cells.corners_of(cells.cells[owners[t]]);
    for (const Index i : corners) {
      ring.push_back(cells.points[i]);
      middle = middle + cells.points[i];
    }
    const std::vector<long double> wanted = planar_wachspress(ring, normalized(middle), targets[t]);
    const NativeRow row = row_of(weights, t);
    ASSERT_EQ(row.columns.size(), ring.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto at = std::ranges::find(row.columns, corners[k]) - row.columns.begin();
      EXPECT_NEAR(row.values[static_cast<std::size_t>(at)], static_cast<double>(wanted[k]), 1e-13);
    }
  }
}

TEST(native, any_voronoi_cells_reproduce_directions) {
  for (const std::size_t n : {20U, 500U, 5000U}) {
    const CellRings cells = voronoi_cells(n, n);
    const std::vector<Point> targets = directions(5000, n + 1);
    const Weights weights = native_weights(cells, targets);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const NativeRow row = row_of(weights, t);
      ASSERT_GE(row.columns.size(), 2U);
      expect_direction(row, cells.points, normalized(targets[t]));
    }
  }
}

TEST(native, triangles_have_the_weights_of_linear) {
  const std::vector<Point> sites = directions(2000, 3);
  const Triangulation triangulation = delaunay(sites);
  CellRings cells;
  cells.points = sites;
  for (const auto& face : triangulation.faces()) {
    cells.append_ring(face);
    cells.end_cell();
  }
  const std::vector<Point> targets = directions(5000, 4);
  const Weights found = native_weights(cells, targets);
  const Weights wanted = Interpolator(triangulation).weights(targets, {.method = Method::linear});
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const NativeRow a = row_of(found, t);
    const NativeRow b = row_of(wanted, t);
    ASSERT_EQ(a.columns.size(), 3U);
    ASSERT_EQ(b.columns.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::ranges::find(b.columns, a.columns[k]) - b.columns.begin();
      ASSERT_LT(at, 3);
      EXPECT_NEAR(a.values[k], b.values[static_cast<std::size_t>(at)], 1e-13);
    }
  }
}

TEST(native, a_side_has_one_value_from_either_cell) {
  // Two cells north and south of the equator, on which double numbers can be exactly.
  const std::vector<LonLat> corners = {{0, 0},  {20, 0}, {25, 11}, {8, 17},
                                       {-3, 9}, {3, -8}, {19, -9}};
  CellRings both;
  both.points = unit_vectors(corners);
  both.append_ring(std::vector<Index>{0, 1, 2, 3, 4});
  both.end_cell();
  both.append_ring(std::vector<Index>{0, 5, 6, 1});
  both.end_cell();
  CellRings north;
  north.points = both.points;
  north.append_cell(both, 0);
  CellRings south;
  south.points = both.points;
  south.append_cell(both, 1);
  std::vector<LonLat> places;
  for (double lon = 0.25; lon < 20; lon += 0.25) places.push_back({lon, 0});
  const std::vector<Point> targets = unit_vectors(places);
  const Weights wanted = native_weights(both, targets);
  EXPECT_EQ(native_weights(north, targets), wanted);
  EXPECT_EQ(native_weights(south, targets), wanted);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const NativeRow row = row_of(wanted, t);
    ASSERT_EQ(row.columns.size(), 2U);
    // Linear in the plane of the chord: the ratio of the sines of the angles to the ends.
    const double to_east = (20 - places[t].lon_deg) * std::numbers::pi / 180;
    const double to_west = places[t].lon_deg * std::numbers::pi / 180;
    const double of_west = std::sin(to_east) / (std::sin(to_east) + std::sin(to_west));
    EXPECT_NEAR(row.values[row.columns[0] == 0 ? 0 : 1], of_west, 1e-15);
  }
  // Close to the side, values are close to those on it.
  std::vector<LonLat> near = places;
  for (LonLat& place : near) place.lat_deg = 1e-12;
  const std::vector<Point> beside = unit_vectors(near);
  const std::vector<double> values = {3, -1, 40, 7, 2, 5, 9};
  std::vector<double> on_side(targets.size());
  std::vector<double> next_to_it(targets.size());
  apply(wanted, values, on_side);
  apply(native_weights(both, beside), values, next_to_it);
  for (std::size_t t = 0; t < targets.size(); ++t) EXPECT_NEAR(on_side[t], next_to_it[t], 1e-11);
}

// Renumbers points, begins rings elsewhere, turns some of them, and changes the order of the cells.
CellRings shuffled(const CellRings& cells, std::vector<Index>& names, Random& random) {
  names.resize(cells.points.size());
  std::iota(names.begin(), names.end(), Index{0});
  for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[random.below(i)]);
  std::vector<std::size_t> order(cells.num_cells());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  CellRings made;
  made.points.resize(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) made.points[names[i]] = cells.points[i];
  for (const std::size_t cell : order) {
    std::vector<Index> ring;
    for (const Index i : cells.corners_of(cells.cells[cell])) ring.push_back(names[i]);
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random.below(ring.size())),
                ring.end());
    if (random.coin()) std::ranges::reverse(ring);
    made.append_ring(ring);
    made.end_cell();
  }
  return made;
}

TEST(native, bytes_do_not_depend_on_numbers_or_threads) {
  const CellRings cells = voronoi_cells(700, 5);
  Random random(6);
  std::vector<Index> names;
  const CellRings others = shuffled(cells, names, random);
  const std::vector<Point> targets = directions(4000, 12);
  const Weights wanted = native_weights(cells, targets, {.threads = 1});
  const Weights found = native_weights(others, targets, {.threads = 2});
  EXPECT_EQ(found.values, wanted.values);
  EXPECT_EQ(found.offsets, wanted.offsets);
  for (std::size_t k = 0; k < wanted.columns.size(); ++k) {
    EXPECT_EQ(found.columns[k], names[wanted.columns[k]]);
  }
}

// A star around a place: corners at any distances, in the order of their angles.
std::vector<LonLat> star(const LonLat& middle, std::size_t n, Random& random) {
  std::vector<LonLat> corners;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.8 * random.unit()) /
                         static_cast<double>(n);
    const double radius = 1 + 9 * random.unit();
    corners.push_back({middle.lon_deg + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return corners;
}

// Even-odd in the gnomonic plane that touches the sphere at longitude 0 on the equator.
bool is_inside(const std::vector<LonLat>& corners, const LonLat& place) {
  const auto plane = [](const LonLat& p) {
    const Point u = unit_vector(p);
    return std::pair(u.y / u.x, u.z / u.x);
  };
  const auto [x, y] = plane(place);
  bool is_in = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [ax, ay] = plane(corners[k]);
    const auto [bx, by] = plane(corners[(k + 1) % corners.size()]);
    if ((ay > y) == (by > y)) continue;
    if (x < ax + (y - ay) / (by - ay) * (bx - ax)) is_in = !is_in;
  }
  return is_in;
}

TEST(native, cells_that_are_not_convex_have_mean_values) {
  Random random(15);
  std::size_t num_inside = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<LonLat> corners = star({0, 0}, 3 + random.below(9), random);
    const CellRings cell = ring_of(corners);
    std::vector<LonLat> places;
    for (int k = 0; k < 50; ++k) {
      places.push_back({12 * random.signed_unit(), 12 * random.signed_unit()});
    }
    const std::vector<Point> targets = unit_vectors(places);
    const Weights weights = native_weights(cell, targets);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const NativeRow row = row_of(weights, t);
      EXPECT_EQ(!row.columns.empty(), is_inside(corners, places[t]));
      if (row.columns.empty()) continue;
      ++num_inside;
      expect_direction(row, cell.points, targets[t]);
    }
  }
  EXPECT_GT(num_inside, 500U);
}

TEST(native, hanging_nodes_and_repeated_corners_are_corners) {
  // The third corner is in the middle of a side, and the last one repeats the first place.
  const CellRings cell = ring_of({{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}});
  const std::vector<LonLat> places = {{5, 0}, {2.5, 0}, {0, 0}, {5, 5}};
  const Weights weights = native_weights(cell, unit_vectors(places));
  ASSERT_EQ(row_of(weights, 0).columns.size(), 1U);
  EXPECT_EQ(row_of(weights, 0).columns[0], 1U);
  EXPECT_EQ(row_of(weights, 1).columns.size(), 2U);
  EXPECT_EQ(row_of(weights, 2).columns.size(), 1U);
  EXPECT_EQ(row_of(weights, 3).columns.size(), 5U);
  expect_direction(row_of(weights, 3), cell.points, unit_vector(places[3]));
}

TEST(native, cells_around_a_pole_have_it) {
  const CellRings cell = ring_of({{0, 80}, {72, 80}, {144, 80}, {216, 80}, {288, 80}});
  const std::vector<LonLat> places = {{0, 90}, {10, 89}, {0, 79.9}};
  const Weights weights = native_weights(cell, unit_vectors(places));
  for (const double value : row_of(weights, 0).values) EXPECT_NEAR(value, 0.2, 1e-15);
  EXPECT_EQ(row_of(weights, 1).columns.size(), 5U);
  EXPECT_TRUE(row_of(weights, 2).columns.empty());
}

// Targets on the meridians at the border of a dual mesh, whose unit vectors are rounded to either side.
TEST(native, targets_on_the_border_are_found) {
  CellRings faces;
  constexpr int columns = 5;
  constexpr int rows = 7;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      faces.points.push_back(unit_vector({11.0 + column, 20.0 + row}));
    }
  }
  std::vector<Point> centers;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto at = static_cast<Index>(row * (columns + 1) + column);
      const Index above = at + columns + 1;
      faces.append_ring(std::vector<Index>{at, at + 1, above + 1, above});
      faces.end_cell();
      centers.push_back(unit_vector({11.5 + column, 20.5 + row}));
    }
  }
  const CellRings dual = dual_cells(faces, centers);
  std::vector<Point> targets;
  std::vector<Point> beyond;
  for (int k = 0; k <= 600; ++k) {
    for (const double lon : {11.5, 15.5}) {
      const double lat = 20.5 + k / 100.0;
      targets.push_back(unit_vector({lon, lat}));
      beyond.push_back(unit_vector({lon < 13 ? lon - 1e-12 : lon + 1e-12, lat}));
    }
  }
  const Weights weights = native_weights(dual, targets);
  std::size_t num_outside = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const std::uint64_t begin = weights.offsets[t];
    const std::uint64_t end = weights.offsets[t + 1];
    ASSERT_GT(end, begin) << t;
    double sum = 0;
    Point place{0, 0, 0};
    for (std::uint64_t k = begin; k < end; ++k) {
      sum += weights.values[k];
      const Point& center = centers[weights.columns[k]];
      place = {place.x + weights.values[k] * center.x, place.y + weights.values[k] * center.y,
               place.z + weights.values[k] * center.z};
      EXPECT_GE(weights.values[k], 0);
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_LE(end - begin, 4U);
    EXPECT_NEAR(lonlats(std::vector<Point>{place}).front().lat_deg, 20.5 + double(t / 2) / 100,
                1e-12);
    num_outside += orientation(unit_vector({t % 2 == 0 ? 11.5 : 15.5, 20.5}),
                               unit_vector({t % 2 == 0 ? 11.5 : 15.5, 26.5}),
                               targets[t]) == (t % 2 == 0 ? Sign::positive : Sign::negative)
                       ? 1
                       : 0;
  }
  EXPECT_GT(num_outside, 100U);  // that is what rounding does
  EXPECT_EQ(native_weights(dual, beyond).values.size(), 0U);
}

TEST(native, nothing_is_found_without_cells) {
  CellRings cells;
  cells.points = {{1, 0, 0}};
  const std::vector<Point> targets = {{1, 0, 0}};
  const Weights weights = native_weights(cells, targets);
  EXPECT_EQ(weights.num_rows(), 1U);
  EXPECT_EQ(weights.num_columns, 1U);
  EXPECT_TRUE(weights.columns.empty());
  EXPECT_EQ(native_weights(cells, {}).num_rows(), 0U);
}

TEST(native, what_is_no_mesh_is_refused) {
  const CellRings wide = ring_of({{0, 0}, {120, 0}, {240, 0}});
  const std::vector<Point> targets = {{0, 0, 1}};
  EXPECT_THROW((void)native_weights(wide, targets), InvalidInput);
  CellRings holed = ring_of({{0, 0}, {10, 0}, {0, 10}});
  holed.end_ring();
  holed.cells.back() = 2;
  EXPECT_THROW((void)native_weights(holed, targets), InvalidInput);
  CellRings lost = ring_of({{0, 0}, {10, 0}, {0, 10}});
  lost.corners[1] = 7;
  EXPECT_THROW((void)native_weights(lost, targets), InvalidInput);
  const CellRings good = ring_of({{0, 0}, {10, 0}, {0, 10}});
  EXPECT_THROW((void)native_weights(good, std::vector<Point>{{0, 0, 0}}), InvalidInput);
}

TEST(native, duals_of_triangles_are_voronoi_cells) {
  const std::vector<Point> sites = directions(300, 21);
  const Triangulation triangulation = delaunay(sites);
  CellRings triangles;
  triangles.points = sites;
  for (const auto& face : triangulation.faces()) {
    triangles.append_ring(face);
    triangles.end_cell();
  }
  const std::vector<Point> centers = circumcenters(triangulation);
  const CellRings dual = dual_cells(triangles, centers);
  ASSERT_EQ(dual.num_cells(), sites.size());
  const CellSet cells = CellSet::polygons(dual);
  const CellSet wanted = CellSet::voronoi(triangulation);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(cells.areas()[i], wanted.areas()[i], 1e-14);
  }
  // Without one triangle three sites are at a border and have no cell.
  CellRings open;
  open.points = sites;
  for (std::size_t f = 1; f < triangles.num_cells(); ++f) open.append_cell(triangles, f);
  const CellRings fewer = dual_cells(open, std::span(centers).subspan(1));
  EXPECT_EQ(fewer.num_cells(), sites.size() - 3);
}

}  // namespace
}  // namespace rondel::test
