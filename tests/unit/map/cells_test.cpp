// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// CellMap: maps of diagrams whose corners are known by heart.
//
//     cube: the cell of each of its 8 corners          octahedron: the cells of +x and +z, and
//     is an eighth of the sphere                       both parts of the cell of -x
//
//     +----+----+----+----+                            +---------------------+
//     |    |    |    |    |                            |__     __+z_     __--|
//     +----+----+----+----+                            |  |---|     |---|  | |
//     |    |    |    |    |                            |-x| -y| +x  | +y| -x |
//     +----+----+----+----+                            +---------------------+
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "map/cell_map.h"
#include "map/map_plane.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/map/cells_planar.h"

namespace rondel::test::of_cells {
namespace {

using Positions = std::set<LonLat, map::InPlane>;
using Polygons = std::vector<std::vector<map::LonLatPolygon>>;

constexpr double axis_degrees = 180 / std::numbers::pi;

Polygons polygons_of_cells(const std::vector<Point>& sites, double tolerance_deg) {
  const Triangulation triangulation = delaunay(sites);
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, tolerance_deg, {.threads = 1});
  map::CellMap::Pen pen;
  Polygons all;
  for (std::size_t site = 0; site < sites.size(); ++site) all.push_back(map.polygons(site, pen));
  return all;
}

Positions positions_of(const std::vector<map::LonLatPolygon>& polygons) {
  Positions positions;
  for (const map::LonLatPolygon& polygon : polygons)
    positions.insert(polygon.ring.begin(), polygon.ring.end());
  return positions;
}

// Expects a closed ring with these positions, beginning with any of them.
void expect_ring(const std::vector<LonLat>& ring, const std::vector<LonLat>& expected) {
  ASSERT_EQ(ring.size(), expected.size() + 1);
  EXPECT_EQ(ring.front(), ring.back());
  bool is_found = false;
  for (std::size_t first = 0; first < expected.size(); ++first) {
    bool is_same = true;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      is_same = is_same &&
                map::distance_in_plane(ring[k], expected[(first + k) % expected.size()]) < 1e-12;
    }
    is_found = is_found || is_same;
  }
  EXPECT_TRUE(is_found);
}

const std::vector<Point> cube = {{1, 1, 1},  {-1, 1, 1},  {-1, -1, 1},  {1, -1, 1},
                                 {1, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}};

// Four sites of each side of the cube are cocircular, so that two faces have one circumcenter but for rounding: the map has
// one position there. All sides lead along meridians or the equator and have no positions between their ends.
TEST(cell_map, of_the_corners_of_a_cube) {
  const Polygons all = polygons_of_cells(cube, 0.01);
  Positions positions;
  for (std::size_t site = 0; site < cube.size(); ++site) {
    ASSERT_EQ(all[site].size(), 1U);
    const double west =
        cube[site].y > 0 ? (cube[site].x > 0 ? 0 : 90) : (cube[site].x > 0 ? -90 : -180);
    const double south = cube[site].z > 0 ? 0 : -90;
    expect_ring(all[site][0].ring,
                {{west, south}, {west + 90, south}, {west + 90, south + 90}, {west, south + 90}});
    positions.merge(positions_of(all[site]));
  }
  EXPECT_EQ(positions.size(), 15U);  // five longitudes, three latitudes
}

const std::vector<Point> octahedron = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                       {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
const double corner_lat = std::atan(std::sqrt(0.5)) * axis_degrees;  // 35.26

// An eighth of the distance of neighbors is 10.1 degrees. The arc from (-45, 35.26) to (45, 35.26) is 9.7 degrees from its
// line, which is more than nine tenths of that, so it is bisected once, however large the tolerance is.
TEST(cell_map, of_an_octahedron_is_as_coarse_as_the_distances_of_sites_allow) {
  const Polygons all = polygons_of_cells(octahedron, 45);
  ASSERT_EQ(all[0].size(), 1U);
  for (const std::size_t site : {std::size_t{0}, std::size_t{1}}) {
    const double lon = site == 0 ? 0 : 90;
    expect_ring(all[site][0].ring, {{lon - 45, -corner_lat},
                                    {lon, -45},
                                    {lon + 45, -corner_lat},
                                    {lon + 45, corner_lat},
                                    {lon, 45},
                                    {lon - 45, corner_lat}});
  }
  ASSERT_EQ(all[3].size(), 2U);
  const std::size_t east = all[3][0].ring[0].lon_deg > 0 ? 0 : 1;
  EXPECT_NEAR(planar_area(all[3][east].ring), planar_area(all[3][1 - east].ring), 1e-10);
  ASSERT_EQ(all[2].size(), 1U);
  const Positions around_pole = positions_of(all[2]);
  EXPECT_TRUE(around_pole.contains({-180, 90}));
  EXPECT_TRUE(around_pole.contains({180, 90}));
  EXPECT_FALSE(around_pole.contains({180, -90}));
}

// A point of the cell of a site is nearest to it; on a side two coordinates are equal. The sides between longitudes -45 and
// 45 are densified to the tolerance, those along meridians are not.
TEST(cell_map, of_an_octahedron_is_near_its_arcs) {
  for (const double tolerance_deg : {8.0, 1.0, 0.01}) {
    const Polygons all = polygons_of_cells(octahedron, tolerance_deg);
    double total = 0;
    for (std::size_t site = 0; site < octahedron.size(); ++site) {
      EXPECT_EQ(fault(all[site]), "") << site;
      total += planar_area(all[site]);
      EXPECT_NEAR(spherical_area(all[site]), 4 * std::numbers::pi / 6,
                  tolerance_deg * 8 / axis_degrees);
    }
    EXPECT_NEAR(total, 360 * 180, 1e-9);
    const std::vector<LonLat>& ring = all[0][0].ring;
    EXPECT_GT(ring.size(), 5U);
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
      const LonLat middle{(ring[k].lon_deg + ring[k + 1].lon_deg) / 2,
                          (ring[k].lat_deg + ring[k + 1].lat_deg) / 2};
      const double arc_lat = std::atan(std::cos(middle.lon_deg / axis_degrees)) * axis_degrees;
      const double away = std::abs(middle.lat_deg) < corner_lat - 1e-9
                              ? std::abs(std::abs(middle.lon_deg) - 45)
                              : std::abs(std::abs(middle.lat_deg) - arc_lat);
      EXPECT_LE(away, tolerance_deg) << k;
    }
    // Neighbors have the positions of the side between them, bit by bit.
    const Positions north = positions_of(all[2]);
    for (const LonLat& p : ring) {
      if (p.lat_deg > corner_lat - 1e-9) {
        EXPECT_TRUE(north.contains(p)) << p.lon_deg;
      }
    }
  }
}

// The cells of sites that are on a circle but for rounding, or of circles about one ray, are so narrow that the lines of both
// sides would cross. They are mended: cells are valid, fill the map, and have each line in common with one neighbor.
void expect_whole_map(const Triangulation& triangulation, double tolerance_deg) {
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, tolerance_deg, {.threads = 1});
  map::CellMap::Pen pen;
  std::map<std::array<double, 4>, int> balance;  // of lines in both directions
  double total = 0;
  for (std::size_t site = 0; site < triangulation.num_sites(); ++site) {
    if (!map.has_cell(site)) continue;
    const auto& polygons = map.polygons(site, pen);
    EXPECT_EQ(fault(polygons), "") << site;
    total += planar_area(polygons);
    for (const map::LonLatPolygon& polygon : polygons) {
      for (std::size_t k = 0; k + 1 < polygon.ring.size(); ++k) {
        const auto [p_lon, p_lat] = polygon.ring[k];
        const auto [q_lon, q_lat] = polygon.ring[k + 1];
        const bool is_border =
            (p_lon == q_lon && std::abs(p_lon) == 180) || (p_lat == q_lat && std::abs(p_lat) == 90);
        if (is_border) continue;
        ++balance[{p_lon, p_lat, q_lon, q_lat}];
        --balance[{q_lon, q_lat, p_lon, p_lat}];
      }
    }
  }
  EXPECT_NEAR(total, 360 * 180, 1e-8);
  for (const auto& [line, difference] : balance)
    EXPECT_EQ(difference, 0) << line[0] << ' ' << line[1];
}

TEST(cell_map, of_narrow_cells_is_mended) {
  for (const char* kind : {"rotated_circle_0", "meridian_rounded"}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const SiteSet set = generator(kind).make(12, seed);
      const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
      for (const double tolerance_deg : {0.1, 5.0}) expect_whole_map(triangulation, tolerance_deg);
    }
  }
  const std::vector<Point> on_rays = {{0.25, 0, 0}, {-1, 96, 5472}, {-0.25, 24, 1368}, {-3, 3, -3}};
  for (const double tolerance_deg : {0.1, 1.0, 5.0})
    expect_whole_map(delaunay(on_rays, {.model = Model::weighted}), tolerance_deg);
}

// Sites on the equator have cells from pole to pole. Their sides are halfway between the sites and have a corner on the
// equator. The cell of the site at 180 degrees has a part on each side of the antimeridian.
TEST(cell_map, of_sites_on_the_equator_has_columns) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Polygons all = polygons_of_cells(sites, 0.01);
  expect_ring(all[0][0].ring, {{-45, -90}, {45, -90}, {45, 0}, {45, 90}, {-45, 90}, {-45, 0}});
  expect_ring(all[1][0].ring, {{45, -90}, {135, -90}, {135, 0}, {135, 90}, {45, 90}, {45, 0}});
  expect_ring(all[3][0].ring,
              {{-135, -90}, {-45, -90}, {-45, 0}, {-45, 90}, {-135, 90}, {-135, 0}});
  ASSERT_EQ(all[2].size(), 2U);
  EXPECT_NEAR(planar_area(all[2][0].ring), 45 * 180, 1e-10);
  EXPECT_NEAR(planar_area(all[2][1].ring), 45 * 180, 1e-10);
}

TEST(cell_map, of_one_site_is_all_of_the_map_and_of_its_duplicate_nothing) {
  const std::vector<Point> sites = {{2, 0, 0}, {4, 0, 0}};
  const Triangulation triangulation = delaunay(sites);
  const Cells diagram = cells(triangulation);
  const map::CellMap map(triangulation, diagram, 1, {});
  map::CellMap::Pen pen;
  const std::size_t vertex = triangulation.ring().front();
  EXPECT_TRUE(map.has_cell(vertex));
  EXPECT_FALSE(map.has_cell(1 - vertex));
  expect_ring(map.polygons(vertex, pen)[0].ring, {{-180, -90}, {180, -90}, {180, 90}, {-180, 90}});
}

}  // namespace
}  // namespace rondel::test::of_cells
