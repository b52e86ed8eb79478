// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons in flat arrays: those of the maps of cells and faces, each with its owner.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/cell_map.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/polygons.h"
#include "support/generators.h"
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
    const auto first = all.positions.begin();
    found.push_back({{first + static_cast<std::ptrdiff_t>(all.offsets[k]),
                      first + static_cast<std::ptrdiff_t>(all.offsets[k + 1])}});
  }
  return found;
}

void expect_arrays(const LonLatPolygons& all) {
  ASSERT_EQ(all.offsets.size(), all.owners.size() + 1);
  EXPECT_EQ(all.offsets.front(), 0U);
  EXPECT_EQ(all.offsets.back(), all.positions.size());
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

TEST(cells, arrays_want_a_tolerance) {
  const Triangulation t =
      delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}});
  const Diagram dual = diagram(t);
  for (const double wrong : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(cell_polygons(t, dual, wrong), InvalidInput);
  }
  if (is_shortened()) return;  // millions of points
  const LonLatPolygons finest = cell_polygons(t, dual, least_tolerance_deg);
  EXPECT_EQ(cell_polygons(t, dual, 1e-300).positions, finest.positions);
}

TEST(cells, arrays_want_the_diagram_of_the_triangulation) {
  const std::vector<Point> sites = random_points(20, 5);
  const Triangulation fewer = delaunay(std::span(sites).first(19));
  EXPECT_THROW(cell_polygons(fewer, diagram(delaunay(sites))), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
