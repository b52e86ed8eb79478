// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons in flat arrays: those of the maps of cells and faces, each with its owner.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "map/arc.h"
#include "map/cell_map.h"
#include "map/common_corners.h"
#include "rondel/cell_rings.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/polygons.h"
#include "support/generators.h"
#include "support/random.h"
#include "unit/map/cells_planar.h"

namespace rondel::test {
namespace {

std::vector<Point> random_points(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points(n);
  std::ranges::generate(points, [&] { return random_direction(random); });
  return points;
}

// The polygons of an owner, out of the arrays.
std::vector<map::LonLatPolygon> polygons_of(const LonLatPolygons& all, Index owner) {
  std::vector<map::LonLatPolygon> found;
  for (std::size_t k = 0; k < all.owners.size(); ++k) {
    if (all.owners[k] != owner) continue;
    found.push_back({{all.rings[k].begin(), all.rings[k].end()}});
  }
  return found;
}

void expect_arrays(const LonLatPolygons& all) {
  ASSERT_EQ(all.rings.size(), all.owners.size());
  EXPECT_EQ(all.rings.offsets.front(), 0U);
  EXPECT_EQ(all.rings.offsets.back(), all.rings.values.size());
  EXPECT_TRUE(std::is_sorted(all.owners.begin(), all.owners.end()));
}

TEST(cells, arrays_have_the_polygons_of_every_site) {
  std::vector<Point> sites = random_points(1500, 3);
  sites.push_back(sites[7]);
  const Triangulation triangulation = delaunay(sites);
  const Diagram dual = diagram(triangulation);
  const LonLatPolygons all = cell_polygons(triangulation, dual);
  expect_arrays(all);
  const map::CellMap map(triangulation, dual.cells, 0.01, {.threads = 1});
  map::CellMap::Pen pen;
  for (Index site = 0; site < sites.size(); ++site) {
    const auto found = polygons_of(all, site);
    const auto expected = map.has_cell(site) ? map.polygons(site, pen) : decltype(found){};
    ASSERT_EQ(found.size(), expected.size()) << site;
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_TRUE(
          std::ranges::equal(found[k].ring, expected[k].ring, [](const LonLat& a, const LonLat& b) {
            return a.lon_deg == b.lon_deg && a.lat_deg == b.lat_deg;
          }));
    }
  }
}

TEST(cells, arrays_of_faces_fill_the_map) {
  const std::vector<Point> sites = random_points(1500, 4);
  const Triangulation triangulation = delaunay(sites);
  const LonLatPolygons all = face_polygons(triangulation);
  expect_arrays(all);
  double total = 0;
  for (Index face = 0; face < triangulation.num_faces(); ++face) {
    const auto polygons = polygons_of(all, face);
    EXPECT_EQ(fault(polygons), "") << face;
    total += planar_area(polygons);
  }
  EXPECT_NEAR(total, 360 * 180, 1e-7);
}

TEST(cells, arrays_are_empty_without_sites) {
  const Triangulation none = delaunay(std::vector<Point>{});
  expect_arrays(cell_polygons(none, diagram(none)));
  expect_arrays(face_polygons(none));
}

TEST(arc_lines, end_where_the_map_does) {
  const std::vector<LonLat> places = {{170, 0}, {-170, 0}, {10, 0}, {10, 1}, {0, 0}, {180, 0}};
  const std::vector<Point> p = unit_vectors(places);
  const std::vector<std::array<Point, 2>> arcs = {{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}};
  const CompressedRows<LonLat> lines = arc_lines(arcs);
  ASSERT_EQ(lines.size(), 3U);  // none between opposite ends
  for (const std::size_t i : {0U, 1U}) {
    for (const LonLat& place : lines[i]) EXPECT_NEAR(place.lat_deg, 0, 1e-12);
  }
  EXPECT_NEAR(lines[0].front().lon_deg, 170, 1e-12);
  EXPECT_EQ(lines[0].back().lon_deg, 180);
  EXPECT_EQ(lines[1].front().lon_deg, -180);
  EXPECT_NEAR(lines[2].back().lat_deg, 1, 1e-12);
  EXPECT_THROW(arc_lines(arcs, 0), InvalidInput);
}

TEST(cells, arrays_want_a_tolerance) {
  const Triangulation t =
      delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}});
  const Diagram dual = diagram(t);
  for (const double wrong : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(cell_polygons(t, dual, wrong), InvalidInput);
  }
  if (is_shortened()) return;  // millions of points
  const LonLatPolygons finest = cell_polygons(t, dual, min_tolerance_deg);
  EXPECT_EQ(cell_polygons(t, dual, 1e-300).rings.values, finest.rings.values);
}

TEST(cells, arrays_want_the_diagram_of_the_triangulation) {
  const std::vector<Point> sites = random_points(20, 5);
  const Triangulation fewer = delaunay(std::span(sites).first(19));
  EXPECT_THROW(cell_polygons(fewer, diagram(delaunay(sites))), InvalidInput);
}

// Feet on arcs, and corners that cells of one side of a great circle have on arcs of the other side.

TEST(foot_on_arc, is_below_points_between_the_ends) {
  Random random(51);
  int num_inside = 0;
  for (int round = 0; round < 2000; ++round) {
    const Point p = random.direction();
    const Point normal = normalized(cross(p, random.direction()));
    const Point ahead = cross(normal, p);
    const double length = 0.01 + 2.4 * random.unit();
    const auto on_circle = [&](double angle) {
      return std::cos(angle) * p + std::sin(angle) * ahead;
    };
    const double share = 1.6 * random.unit() - 0.3;
    const double height = 2.8 * random.unit() - 1.4;
    const Point below = on_circle(share * length);
    const Point v = std::cos(height) * below + std::sin(height) * normal;
    const std::optional<Point> foot = map::foot_on_arc(v, p, on_circle(length));
    if (std::abs(share) < 1e-3 || std::abs(share - 1) < 1e-3) continue;
    const bool is_inside = share > 0 && share < 1;
    ASSERT_EQ(foot.has_value(), is_inside) << round;
    if (!is_inside) continue;
    ++num_inside;
    EXPECT_LT(map::distance(*foot, below), 1e-12) << round;
  }
  EXPECT_GT(num_inside, 1000);
}

std::vector<double> random_cuts(Random& random, std::size_t count) {
  std::vector<double> cuts = {-60, 60};
  while (cuts.size() < count) cuts.push_back(110 * random.unit() - 55);
  std::ranges::sort(cuts);
  return cuts;
}

// Cells on both sides of a great circle, with corners of their own on it, in any orientation in space.
struct TwoRows {
  CellRings cells;
  std::vector<std::vector<Index>>
      expected;  // the corners of each ring, with those of the other side

  TwoRows(Random& random, const std::vector<double>& north, const std::vector<double>& south)
      : u_(random.direction()), v_(normalized(cross(u_, random.direction()))), w_(cross(u_, v_)) {
    const std::vector<Index> places_north = add_points(north, 0);
    const std::vector<Index> places_south = add_points(south, 0);
    add_row(north, places_north, south, places_south, 1);
    add_row(south, places_south, north, places_north, -1);
  }

 private:
  Index add_point(double lon_deg, double lat_deg) {
    const Point p = unit_vector(LonLat{lon_deg, lat_deg});
    const Point turned = p.x * u_ + p.y * v_ + p.z * w_;
    const auto found = std::ranges::find(cells.points, turned);
    if (found == cells.points.end()) cells.points.push_back(turned);
    return static_cast<Index>(std::ranges::find(cells.points, turned) - cells.points.begin());
  }
  std::vector<Index> add_points(const std::vector<double>& cuts, double lat_deg) {
    std::vector<Index> places;
    for (const double cut : cuts) places.push_back(add_point(cut, lat_deg));
    return places;
  }
  void add_row(const std::vector<double>& cuts, const std::vector<Index>& places,
               const std::vector<double>& others, const std::vector<Index>& other_places,
               double side) {
    const std::vector<Index> far = add_points(cuts, 30 * side);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      std::vector<Index> ring = {places[k], places[k + 1], far[k + 1], far[k]};
      std::vector<Index> all = {places[k]};
      for (std::size_t i = 0; i < others.size(); ++i) {
        if (others[i] > cuts[k] && others[i] < cuts[k + 1]) all.push_back(other_places[i]);
      }
      all.insert(all.end(), ring.begin() + 1, ring.end());
      if (side < 0) {
        std::ranges::reverse(ring);
        std::ranges::reverse(all);
      }
      cells.corners.insert(cells.corners.end(), ring.begin(), ring.end());
      cells.rings.push_back(cells.corners.size());
      cells.cells.push_back(cells.rings.size() - 1);
      expected.push_back(std::move(all));
    }
  }

  Point u_;
  Point v_;
  Point w_;
};

TEST(common_corners, are_those_of_the_other_side) {
  Random random(52);
  for (int round = 0; round < 60; ++round) {
    const TwoRows rows(random, random_cuts(random, 2 + random.below(12)),
                       random_cuts(random, 2 + random.below(12)));
    const map::CommonCorners common(rows.cells, rows.cells.points, round % 2 == 0 ? 1 : 2);
    for (std::size_t r = 0; r < rows.expected.size(); ++r) {
      const std::span<const Index> ring =
          std::span(rows.cells.corners)
              .subspan(rows.cells.rings[r], rows.cells.rings[r + 1] - rows.cells.rings[r]);
      std::vector<Point> found;
      common.append_ring(ring, rows.cells.points, found);
      std::vector<Point> expected;
      for (const Index i : rows.expected[r]) expected.push_back(rows.cells.points[i]);
      EXPECT_EQ(found, expected) << round << ", ring " << r;
    }
  }
}

}  // namespace
}  // namespace rondel::test
