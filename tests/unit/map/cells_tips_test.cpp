// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Tips of narrow cells, where rounding has exchanged the ends of very short arcs.
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map/arc.h"
#include "map/cell_map.h"
#include "map/map_plane.h"
#include "rondel/delaunay.h"
#include "support/generators.h"

namespace rondel::test {
namespace {

using Positions = std::set<LonLat, map::InPlane>;

// The positions of points of a diagram that no short arc ends at, but for poles and the antimeridian.
Positions positions_of_points_apart(const Cells& cells) {
  constexpr double apart = 0x1p-29;
  std::set<Index> near;
  for (std::size_t site = 0; site + 1 < cells.offsets.size(); ++site) {
    const std::size_t first = cells.offsets[site];
    const std::size_t size = cells.offsets[site + 1] - first;
    for (std::size_t k = 0; k < size; ++k) {
      const Index p = cells.rings[first + k];
      const Index q = cells.rings[first + (k + 1) % size];
      if (map::distance(cells.points[p], cells.points[q]) < apart) near.insert({p, q});
    }
  }
  Positions positions;
  for (const Index i : cells.rings) {
    const Point p = map::snapped(cells.points[i]);
    if (!near.contains(i) && !map::is_pole(p) && !(p.y == 0 && p.x < 0))
      positions.insert(map::map_point(p).position);
  }
  return positions;
}

// Expects that the points of a diagram have their positions in its map, bit by bit, unless a short arc ends there.
void expect_points_of_diagram(const Triangulation& triangulation, double tolerance_deg,
                              const std::string& name) {
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, tolerance_deg, {});
  Positions drawn;
  map::CellMap::Pen pen;
  for (std::size_t site = 0; site < triangulation.num_sites(); ++site) {
    for (const map::LonLatPolygon& polygon : map.polygons(site, pen))
      drawn.insert(polygon.ring.begin(), polygon.ring.end());
  }
  const Positions expected = positions_of_points_apart(diagram);
  EXPECT_GT(expected.size(), 3U) << name;
  for (const LonLat& p : expected)
    EXPECT_TRUE(drawn.contains(p)) << name << ": " << p.lon_deg << ' ' << p.lat_deg;
}

// Sites on a circle, but for rounding, have cells of two long sides and tips at the poles of the circle. The short arcs at
// the tips shrink to points, and all other points of the diagram keep their positions, bit by bit.
TEST(cell_map_tips, shrink_and_leave_other_points_where_they_are) {
  for (const auto& [name, seed] :
       {std::pair("meridian_rounded", 2U), std::pair("rotated_circle_0", 1U)}) {
    const SiteSet set = generator(name).make(150, seed);
    expect_points_of_diagram(delaunay(set.sites, {.sphere = set.sphere}), 0.01, name);
  }
}

// The cell of a circle that is so narrow that the lines of both its sides have changed places is mended where it is.
TEST(cell_map_tips, turned_lunes_leave_points_where_they_are) {
  const std::vector<std::vector<Point>> sets = {
      {{0.125, 0, 0}, {-1, 128, 7296}, {-0.125, 16, 912}, {-3, 3, -3}},
      {{-36, 3.0625, 15.375}, {19, 1840, 91}, {38, 3680, 182}, {76, 7360, 364}, {-3, -3, -3}}};
  for (const std::vector<Point>& sites : sets) {
    for (const double tolerance_deg : {5.0, 0.5, 0.1}) {
      expect_points_of_diagram(delaunay(sites, {.model = Model::weighted}), tolerance_deg,
                               std::to_string(tolerance_deg));
    }
  }
}

// So few sites have the tips of the cells above in no time.
TEST(cell_map_tips, of_few_sites_shrink_where_they_are) {
  for (const char* kind : {"rotated_circle_0", "meridian_rounded"}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const SiteSet set = generator(kind).make(10, seed);
      const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
      for (const double tolerance_deg : {0.1, 5.0})
        expect_points_of_diagram(triangulation, tolerance_deg, kind);
    }
  }
  const std::vector<std::vector<Point>> sets = {
      {{0.25, 0, 0}, {-1, 96, 5472}, {-0.25, 24, 1368}, {-3, 3, -3}},
      {{-18, 3.0625, 15.375}, {19, 920, 91}, {38, 1840, 182}, {76, 3680, 364}, {-3, -3, -3}}};
  for (const std::vector<Point>& sites : sets) {
    for (const double tolerance_deg : {5.0, 0.1}) {
      expect_points_of_diagram(delaunay(sites, {.model = Model::weighted}), tolerance_deg,
                               "on one ray");
    }
  }
}

}  // namespace
}  // namespace rondel::test
