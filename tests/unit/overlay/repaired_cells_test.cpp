// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of netCDF that cross themselves, against triangles between the places where great circles cross,
// and against the number of sides between a place and one outside.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "exact/vector.h"
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_cull.h"
#include "rondel/predicates.h"
#include "rondel/read_cells.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "support/random.h"
#include "support/temporary_files.h"
#include "unit/meshing/writer.h"

namespace rondel::test {
namespace {

using CornerRing = std::vector<LonLat>;

const CellFileOptions repaired_if_crossing = {.invalid = InvalidPolygons::repair};

std::string path_of_cells() {
  return temporary_path("repaired_") +
         testing::UnitTest::GetInstance()->current_test_info()->name() + ".nc";
}

std::size_t most_of(const std::vector<CornerRing>& cells) {
  std::size_t most = 0;
  for (const CornerRing& ring : cells) most = std::max(most, ring.size());
  return most;
}

// Cells as SCRIP has them, the last corner repeated.
std::string scrip_file(const std::vector<CornerRing>& cells) {
  const std::size_t most = most_of(cells);
  std::vector<double> lon;
  std::vector<double> lat;
  for (const CornerRing& ring : cells) {
    for (std::size_t k = 0; k < most; ++k) {
      lon.push_back(ring[std::min(k, ring.size() - 1)].lon_deg);
      lat.push_back(ring[std::min(k, ring.size() - 1)].lat_deg);
    }
  }
  MeshWriter file;
  const MeshWriter::Dimensions corners = {{"grid_size", cells.size()}, {"grid_corners", most}};
  file.add("grid_corner_lon", corners, lon, {{"units", "degrees"}});
  file.add("grid_corner_lat", corners, lat, {{"units", "degrees"}});
  file.write(path_of_cells());
  return path_of_cells();
}

// Cells as UGRID has them.
std::string ugrid_file(const std::vector<CornerRing>& cells) {
  const std::size_t most = most_of(cells);
  std::vector<double> lon;
  std::vector<double> lat;
  std::vector<double> nodes;
  for (const CornerRing& ring : cells) {
    for (std::size_t k = 0; k < most; ++k) {
      nodes.push_back(k < ring.size() ? static_cast<double>(lon.size()) : -1);
      if (k >= ring.size()) continue;
      lon.push_back(ring[k].lon_deg);
      lat.push_back(ring[k].lat_deg);
    }
  }
  MeshWriter file;
  const MeshWriter::Dimensions of_node = {{"node", lon.size()}};
  file.add_whole("mesh", {}, {0},
                 {{"cf_role", "mesh_topology"},
                  {"node_coordinates", "node_x node_y"},
                  {"face_node_connectivity", "face_nodes"}},
                 {{"topology_dimension", 2}});
  file.add("node_x", of_node, lon, {{"units", "degrees_east"}});
  file.add("node_y", of_node, lat, {{"units", "degrees_north"}});
  file.add_whole("face_nodes", {{"face", cells.size()}, {"corner", most}}, nodes, {},
                 {{"_FillValue", -1}});
  file.write(path_of_cells());
  return path_of_cells();
}

// The area of a triangle from its normals and their angles, in extended precision.
double exact_triangle_area(const Point& a, const Point& b, const Point& c) {
  using Real = long double;
  const auto det = [](const Point& p, const Point& q, const Point& r) {
    return Real{p.x} * (Real{q.y} * r.z - Real{q.z} * r.y) +
           Real{p.y} * (Real{q.z} * r.x - Real{q.x} * r.z) +
           Real{p.z} * (Real{q.x} * r.y - Real{q.y} * r.x);
  };
  const auto product = [](const Point& p, const Point& q) {
    return Real{p.x} * q.x + Real{p.y} * q.y + Real{p.z} * q.z;
  };
  return static_cast<double>(
      2 * std::atan2(std::abs(det(a, b, c)), 1 + product(a, b) + product(b, c) + product(c, a)));
}

// Where the great circles through two pairs of places cross, on the side of the first place.
Point crossing_of_circles(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  const Point first = cross(unit_vector(a), unit_vector(b));
  const Point place = normalized(cross(first, cross(unit_vector(c), unit_vector(d))));
  return dot(place, unit_vector(a)) < 0 ? -1.0 * place : place;
}

// Returns the place at an angle around a middle, in degrees, seen from above.
LonLat place_around(const LonLat& middle, double distance_deg, double turn) {
  constexpr double degree = std::numbers::pi / 180;
  const Point up = unit_vector(middle);
  const Point east = normalized(cross({0, 0, 1}, up));
  const Point north = cross(up, east);
  const double s = std::sin(distance_deg * degree);
  const Point place = std::cos(distance_deg * degree) * up +
                      s * std::cos(2 * std::numbers::pi * turn) * east +
                      s * std::sin(2 * std::numbers::pi * turn) * north;
  return lonlats(std::vector<Point>{place}).front();
}

// A quadrilateral whose second and fourth side cross.
CornerRing crossed_quadrilateral(const LonLat& middle, double size_deg) {
  CornerRing ring;
  for (const double turn : {0.05, 0.41, 0.9, 0.6}) {
    ring.push_back(place_around(middle, size_deg, turn));
  }
  return ring;
}
double area_of_tie(const CornerRing& tie) {
  const Point at = crossing_of_circles(tie[1], tie[2], tie[3], tie[0]);
  return exact_triangle_area(unit_vector(tie[0]), unit_vector(tie[1]), at) +
         exact_triangle_area(unit_vector(tie[2]), unit_vector(tie[3]), at);
}

// Five corners, each joined to the next but one: all sides turn left, and the inner pentagon is
// enclosed twice.
CornerRing pentagram(const LonLat& middle, double size_deg) {
  CornerRing ring;
  for (int k = 0; k < 5; ++k) ring.push_back(place_around(middle, size_deg, 0.4 * k + 0.03));
  return ring;
}
double area_of_pentagram(const CornerRing& star) {
  double sum = 0;
  const auto corner = [&](std::size_t k) { return star[k % 5]; };
  for (std::size_t k = 0; k < 5; ++k) {
    // The tip is cut off by the side between the two corners beside it.
    const Point one = crossing_of_circles(corner(k), corner(k + 1), corner(k + 2), corner(k + 3));
    const Point other = crossing_of_circles(corner(k), corner(k + 4), corner(k + 2), corner(k + 3));
    sum += exact_triangle_area(unit_vector(corner(k)), one, other);
  }
  return sum;
}

const CornerRing plain_cell = {{100, 10}, {110, 10}, {110, 20}, {100, 20}};

TEST(repaired_cells, have_the_areas_of_their_triangles) {
  const CornerRing tie = crossed_quadrilateral({20, 35}, 4);
  const CornerRing polar_tie = crossed_quadrilateral({-60, 88}, 5);
  const CornerRing star = pentagram({179, -20}, 12);
  const std::vector<CornerRing> all = {plain_cell, tie, star, plain_cell, polar_tie};
  const CellRings alone = CellSet::read({scrip_file({plain_cell}), {}}).rings();
  for (const std::string& file : {scrip_file(all), ugrid_file(all)}) {
    const CellSet given = CellSet::read({file, {}});
    EXPECT_THROW((void)given.areas(), InvalidInput);
    const CellSet cells = CellSet::read({file, {}}, repaired_if_crossing);
    const std::span<const double> found = cells.areas();
    EXPECT_EQ(found[0], areas(alone)[0]);
    EXPECT_NEAR(found[1], area_of_tie(tie), 1e-14);
    EXPECT_NEAR(found[2], area_of_pentagram(star), 1e-13);
    EXPECT_EQ(found[3], found[0]);
    EXPECT_NEAR(found[4], area_of_tie(polar_tie), 1e-14);
    EXPECT_TRUE(crossing_cells(cells.rings()).empty());
  }
}

TEST(repaired_cells, are_told) {
  const std::vector<CornerRing> all = {plain_cell, crossed_quadrilateral({20, 35}, 4),
                                       crossed_quadrilateral({-60, 8}, 4)};
  const CellSet cells = CellSet::read({scrip_file(all), {}}, repaired_if_crossing);
  const CellFacts& facts = cells.facts();
  ASSERT_EQ(facts.faults.size(), 3U);
  EXPECT_EQ(facts.faults[0], "");
  EXPECT_TRUE(facts.faults[1].starts_with("crosses or overlaps itself at 2")) << facts.faults[1];
  EXPECT_TRUE(facts.faults[2].starts_with("crosses or overlaps itself at -")) << facts.faults[2];
  EXPECT_EQ(facts.remarks,
            std::vector{"cell 1 was repaired (it " + facts.faults[1] + "), and 1 more"});
  EXPECT_TRUE(
      CellSet::read({scrip_file({plain_cell}), {}}, repaired_if_crossing).facts().faults.empty());
  // What is sound is not told of again.
  EXPECT_EQ(cells.repaired().facts().remarks, facts.remarks);
}

TEST(repaired_cells, others_stay_bit_by_bit) {
  const CornerRing next = {{110, 10}, {120, 10}, {120, 20}, {110, 20}};
  const CellRings before = CellSet::read({scrip_file({plain_cell, next}), {}}).rings();
  const std::vector<CornerRing> all = {plain_cell, crossed_quadrilateral({20, 35}, 4), next};
  const CellRings after = CellSet::read({scrip_file(all), {}}, repaired_if_crossing).rings();
  for (const auto& [old_cell, new_cell] : {std::pair{0U, 0U}, {1U, 2U}}) {
    const std::span<const Index> from = before.corners_of(before.cells[old_cell]);
    const std::span<const Index> to = after.corners_of(after.cells[new_cell]);
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
      EXPECT_TRUE(is_same_site(before.points[from[k]], after.points[to[k]]));
    }
  }
  // Both squares have the same two corners between them.
  const std::span<const Index> left = after.corners_of(after.cells[0]);
  const std::span<const Index> right = after.corners_of(after.cells[2]);
  EXPECT_EQ(std::ranges::count_if(left, [&](Index p) { return std::ranges::count(right, p) == 1; }),
            2);
}

TEST(repaired_cells, take_part_in_remaps) {
  const CornerRing tie = crossed_quadrilateral({20, 35}, 4);
  const CellSet cells = CellSet::read({scrip_file({tie, plain_cell}), {}}, repaired_if_crossing);
  const CellSet grid = CellSet::lonlat_grid(GlobalGrid{36, 18});
  EXPECT_THROW((void)remap(CellSet::read({scrip_file({tie, plain_cell}), {}}), grid), InvalidInput);
  const Remap made = remap(cells, grid);
  double sum = 0;
  for (std::size_t i = 0; i < grid.num_cells(); ++i) {
    sum += made.target_fractions[i] * made.target_areas[i];
  }
  EXPECT_NEAR(sum, area_of_tie(tie) + cells.areas()[1], 1e-13);
}

// Whether the arc between two places crosses that between two corners.
bool cross_each_other(const Point& p, const Point& q, const Point& a, const Point& b) {
  if (orientation(p, q, a) == orientation(p, q, b)) return false;
  if (orientation(a, b, p) == orientation(a, b, q)) return false;
  const Point line = cross(cross(p, q), cross(a, b));
  return (dot(line, p + q) > 0) == (dot(line, a + b) > 0);
}

// Corners on a coarse grid give sides that overlap, repeat each other and meet in corners.
TEST(repaired_cells, have_the_places_of_an_odd_number_of_sides) {
  std::size_t num_inside = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const double step = seed % 3 == 0 ? 15 : 1e-3;
    CornerRing ring;
    for (std::uint64_t k = 4 + random.below(6); k > 0; --k) {
      const auto part = [&] { return step * std::round((80 * random.unit() - 40) / step); };
      const double lon = 120 + part();
      ring.push_back({lon, part()});
    }
    CellSet cells;
    try {
      cells = CellSet::read({scrip_file({ring}), {}}, repaired_if_crossing);
    } catch (const FileError&) {
      ADD_FAILURE() << seed;
      continue;
    }
    EXPECT_NO_THROW((void)cells.areas()) << seed;
    const Point outside = unit_vector({-60, 1});
    std::vector<Point> places;
    std::vector<int> expected;
    for (int i = 0; i < 200; ++i) {
      const double lon = 120 + 90 * random.unit() - 45;
      places.push_back(unit_vector({lon, 90 * random.unit() - 45}));
      int count = 0;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = unit_vector(ring[k]);
        const Point b = unit_vector(ring[(k + 1) % ring.size()]);
        if (!is_same_site(a, b) && cross_each_other(places.back(), outside, a, b)) ++count;
      }
      expected.push_back(count % 2);
    }
    const std::vector<std::uint8_t> found = mesh::inside(places, cells.rings());
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_EQ(int{found[i]}, expected[i]) << "seed " << seed << ", place " << i;
      num_inside += found[i];
    }
  }
  EXPECT_GT(num_inside, 5000U);
}

}  // namespace
}  // namespace rondel::test
