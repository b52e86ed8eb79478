// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whole diagrams as maps: the polygons of all cells are valid and fill the rectangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "map/cell_map.h"
#include "map/face_map.h"
#include "map/trace.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/map/cells_planar.h"

namespace rondel::test {
namespace {

LonLat position_of(const Point& site) {
  const double scale = std::max({std::abs(site.x), std::abs(site.y), std::abs(site.z)});
  const Point p{site.x / scale, site.y / scale, site.z / scale};
  return {std::atan2(p.y, p.x) * 180 / std::numbers::pi,
          std::atan2(p.z, std::hypot(p.x, p.y)) * 180 / std::numbers::pi};
}

struct Demands {
  bool has_polygons = true;  // no cell is as narrow as rounding
  bool site_inside = true;   // each site lies in its own cell
  bool has_area = true;      // the area of no cell rounds to zero
  double tolerance_deg = 0.01;
};

// Checks the map of the diagram of `sites`.
void expect_map(const std::vector<Point>& sites, const std::string& name,
                const Options& options = {}, const Demands& demands = {}) {
  const Triangulation triangulation = delaunay(sites, options);
  const Cells diagram = cells(triangulation);
  const std::vector<double> own_areas = areas(triangulation);
  const map::CellMap map(triangulation, diagram, demands.tolerance_deg, {.threads = 2});
  map::CellMap::Pen pen;
  double total = 0;
  for (std::size_t site = 0; site < sites.size(); ++site) {
    const auto polygons = map.polygons(site, pen);
    const std::string where = name + ", site " + std::to_string(site);
    EXPECT_TRUE(map.has_cell(site) || own_areas[site] == 0) << where;
    EXPECT_TRUE(own_areas[site] > 0 || !map.has_cell(site) || !demands.has_area) << where;
    total += planar_area(polygons);
    if (!map.has_cell(site)) continue;
    EXPECT_TRUE(!polygons.empty() || !demands.has_polygons) << where;
    EXPECT_EQ(fault(polygons), "") << where;
    EXPECT_NEAR(spherical_area(polygons), own_areas[site], 0.2 * demands.tolerance_deg) << where;
    const LonLat place = position_of(sites[site]);
    const bool is_on_border =
        std::abs(place.lon_deg) > 180 - 1e-12 || std::abs(place.lat_deg) > 90 - 1e-12;
    if (demands.site_inside && !is_on_border) {
      EXPECT_TRUE(contains(polygons, place)) << where;
    }
  }
  EXPECT_NEAR(total, 360 * 180, 1e-7) << name;
}

std::vector<Point> random_sites(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> sites(n);
  std::ranges::generate(sites, [&] { return random_direction(random); });
  return sites;
}

TEST(cell_map, few_sites) {
  expect_map({{1, 0, 0}}, "one site");
  expect_map({{1, 0, 0}, {2, 0, 0}}, "one site twice");
  const Point a = unit_vector({10, 20});
  for (const LonLat& other :
       {LonLat{-170, -20}, LonLat{10.0001, 20}, LonLat{10, -60}, LonLat{100, 80}}) {
    expect_map({a, unit_vector(other)}, "two sites");
  }
  expect_map({{0, 0, 1}, {0, 0, -1}}, "two poles");
  for (std::size_t n = 3; n < 12; ++n) expect_map(random_sites(n, n), "few random sites");
}

TEST(cell_map, sites_on_one_great_circle) {
  for (const int count : {2, 3, 4, 7, 36, 360}) {
    std::vector<Point> equator;
    std::vector<Point> meridian;
    std::vector<Point> tilted;
    std::vector<Point> half;
    for (int i = 0; i < count; ++i) {
      equator.push_back(unit_vector({360.0 * i / count, 0}));
      half.push_back(unit_vector({100.0 * i / count, 0}));
      meridian.push_back(unit_vector({i % 2 == 0 ? 0.0 : 180.0, 180.0 * i / count - 90}));
      tilted.push_back({equator.back().x, equator.back().y, equator.back().x});
    }
    expect_map(equator, "equator");
    expect_map(half, "part of the equator");
    expect_map(meridian, "meridian");
    expect_map(tilted, "tilted circle");
  }
}

TEST(cell_map, random_sites) {
  for (std::size_t n : {20U, 100U, 1000U, 5000U}) expect_map(random_sites(n, n), "random");
}

TEST(cell_map, clusters_at_the_poles_and_the_antimeridian) {
  for (const double radius : {1e-1, 1e-3, 1e-6, 1e-9}) {
    for (const Point& center :
         {Point{0, 0, 1}, Point{0, 0, -1}, Point{-1, 0, 0}, Point{-0.6, 0, 0.8}}) {
      Random random(5);
      std::vector<Point> sites = random_sites(30, 6);
      for (int i = 0; i < 200; ++i) sites.push_back(random_near(random, center, radius));
      expect_map(sites, "cluster of radius " + std::to_string(radius));
    }
  }
}

// All sites in one region: its outer cells are wedges that meet on the other side of the earth.
TEST(cell_map, regions) {
  for (const double radius : {1e-1, 1e-3, 1e-6}) {
    for (const LonLat& center : {LonLat{8, 47}, LonLat{179, -30}, LonLat{0, 0}, LonLat{30, 90}}) {
      Random random(9);
      std::vector<Point> sites;
      for (int i = 0; i < 300; ++i)
        sites.push_back(random_near(random, unit_vector(center), radius));
      expect_map(sites, "region of radius " + std::to_string(radius));
    }
  }
}

TEST(cell_map, grids_of_cocircular_sites) {
  for (const double shift : {0.0, 0.5, 1e-13}) {
    std::vector<Point> grid;
    for (int lat = -90; lat <= 90; lat += 10) {
      for (int lon = -180; lon < 180; lon += 10) {
        grid.push_back(unit_vector({lon + shift, static_cast<double>(lat)}));
      }
    }
    expect_map(grid, "grid");
    std::vector<Point> cap(grid.begin(), grid.begin() + 100);
    expect_map(cap, "part of a grid");
  }
}

TEST(cell_map, close_pairs) {
  std::vector<Point> sites;
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Point site = random_direction(random);
    sites.push_back(site);
    sites.push_back(random_near(random, site, 1.7e-6));  // 1e-4 degrees
  }
  expect_map(sites, "close pairs");
}

TEST(cell_map, weighted_sites) {
  std::vector<Point> sites = random_sites(500, 8);
  Random random(4);
  for (Point& site : sites) site = (1 + 0.01 * random.unit()) * site;
  expect_map(sites, "weighted", {.model = Model::weighted}, {.site_inside = false});
}

// Two of the sites are on one ray, but the center is outside, and both have cells: lunes and
// triangles narrower than the tolerance, beside wide ones.
TEST(cell_map, weighted_sites_on_one_ray) {
  const std::vector<std::vector<Point>> sets = {
      {{-1.609375, 12416, 6}, {-6.4375, 49664, 24}, {-3, -3, -3}},
      {{0.125, 0, 0}, {-1, 128, 7296}, {-0.125, 16, 912}, {-3, 3, -3}},
      {{-36, 3.0625, 15.375}, {19, 1840, 91}, {38, 3680, 182}, {76, 7360, 364}, {-3, -3, -3}}};
  for (const auto& sites : sets) {
    for (const double tolerance_deg : {5.0, 0.5, 0.1, 0.01}) {
      expect_map(sites, "on one ray, within " + std::to_string(tolerance_deg),
                 {.model = Model::weighted},
                 {.site_inside = false, .tolerance_deg = tolerance_deg});
    }
  }
}

// The first cell lies between two rays a few ulps apart: its sides are nearer to each other than
// the rounding of a longitude, and the arcs on both sides have other ends.
TEST(cell_map, sides_nearer_than_rounding) {
  expect_map({{-2.890353594260116e+80, -5.22252821717078e-131, 2.975909622174883e-252},
              {7.378820757197313e+97, -7.494067971628554e-169, 2.4071659291403187e-128},
              {-8.030076873262112e+272, 6.978446977870808e+36, 2.4764021959063186e-156},
              {-0.18301270189221933, -0.18301270189221933, 0.9659258262890683},
              {2, -1, 1},
              {-2.4013222655306476e-169, -4.432160794398033e+177, 0},
              {-8.030076873262112e+272, 6.978446977870805e+36, 2.4764021959063186e-156},
              {2, -3, 2},
              {-1.180321731993123e+144, -5.2092331689555054e+57, 0}},
             "rays few ulps apart", {},
             {.has_polygons = false, .site_inside = false, .has_area = false});
}

// Named degenerate inputs: cells may be no wider than rounding, but the map is valid and without
// gaps.
TEST(cell_map, degenerate_sites) {
  for (const Generator& kind : spherical_generators()) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const SiteSet set = kind.make(300, seed);
      expect_map(set.sites, std::string(kind.name), {.sphere = set.sphere},
                 {.has_polygons = false, .site_inside = false});
    }
  }
}

// The cell of a site, drawn arc by arc, as if there were no other cells.
std::vector<map::LonLatPolygon> drawn_cell(const Triangulation& triangulation, const Cells& cells,
                                           Index site) {
  const double most = 0.01 / map::degrees_per_radian;
  const auto direction = [&](Index i) {
    return map::direction(triangulation.sites().points()[i], triangulation.sphere().center);
  };
  std::vector<Point> ring;
  std::vector<map::ArcTolerance> tolerances;
  for (const Index corner_of_cell : cells.rings[site]) {
    const Triple& face = triangulation.faces()[corner_of_cell];
    const auto corner = static_cast<std::size_t>(std::ranges::find(face, site) - face.begin());
    const Point own = direction(site);
    const Point other = direction(face[(corner + 2) % 3]);
    const double least = std::clamp(norm(own - other) / 8, map::merge_distance, most);
    tolerances.push_back({least, most, (own + other) / norm(own + other)});
    ring.push_back(map::snapped(cells.points[corner_of_cell]));
  }
  map::Trace trace;
  map::draw(ring, tolerances, trace);
  return map::polygons_of(trace);
}

std::vector<map::LonLatPolygon> drawn_face(const Triangulation& triangulation, Index face) {
  const auto corners = [&](Index f) {
    std::array<Point, 3> points;
    std::ranges::transform(triangulation.faces()[f], points.begin(), [&](Index i) {
      return map::direction(triangulation.sites().points()[i], triangulation.sphere().center);
    });
    return points;
  };
  const auto tolerance = [&](Index f) {
    const auto [a, b, c] = corners(f);
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    const double height_deg = norm(cross(b - a, c - b)) / longest * map::degrees_per_radian;
    return std::clamp(height_deg / 10, 1e-5, 0.01);
  };
  std::array<double, 3> tolerances{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Index neighbor = triangulation.neighbors()[face][(i + 2) % 3];
    tolerances[i] = triangulation.is_ghost(neighbor)
                        ? tolerance(face)
                        : std::min(tolerance(face), tolerance(neighbor));
  }
  return map::lonlat_polygons(corners(face), tolerances);
}

void expect_equal(const std::vector<map::LonLatPolygon>& found,
                  const std::vector<map::LonLatPolygon>& expected, Index of) {
  ASSERT_EQ(found.size(), expected.size()) << of;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].ring == expected[i].ring) << of;
  }
}

// Cells and faces of all sizes, small ones around the poles, the antimeridian and elsewhere.
std::vector<std::vector<Point>> sites_of_all_sizes() {
  std::vector<std::vector<Point>> sets = {random_sites(30, 1), random_sites(4000, 2)};
  for (const double radius : {0.05, 1e-3, 1e-6}) {
    for (const LonLat& center :
         {LonLat{0, 90}, LonLat{0, -90}, LonLat{180, 20}, LonLat{0, -30}, LonLat{77, 60}}) {
      Random random(11);
      std::vector<Point> sites = random_sites(30, 6);
      for (int i = 0; i < 500; ++i) {
        sites.push_back(random_near(random, unit_vector(center), radius));
      }
      sets.push_back(std::move(sites));
    }
  }
  return sets;
}

TEST(cell_map, has_each_cell_as_it_is_drawn) {
  for (const std::vector<Point>& sites : sites_of_all_sizes()) {
    const Triangulation triangulation = delaunay(sites);
    const Cells diagram = cells(triangulation);
    const map::CellMap map(triangulation, diagram, 0.01, {});
    map::CellMap::Pen pen;
    for (Index site = 0; site < sites.size(); ++site) {
      expect_equal(map.polygons(site, pen), drawn_cell(triangulation, diagram, site), site);
    }
  }
}

bool is_on_border(const LonLat& p, const LonLat& q) {
  return (p.lon_deg == q.lon_deg && std::abs(p.lon_deg) == 180) ||
         (p.lat_deg == q.lat_deg && std::abs(p.lat_deg) == 90);
}

// Each line inside the map is a side of two cells, bit by bit, also where lines crossed and arcs
// of plain cells have changed since.
TEST(cell_map, has_each_line_in_the_cells_on_both_sides) {
  std::size_t num_maps = 0;
  for (const Generator& kind : generators()) {
    if (kind.weighted_only) continue;
    const SiteSet set = kind.make(is_shortened() ? 100 : 300, 5);
    const Triangulation triangulation = delaunay(set.sites, {.sphere = set.sphere});
    const Cells diagram = cells(triangulation);
    const map::CellMap map(triangulation, diagram, 0.01, {.threads = 2});
    map::CellMap::Pen pen;
    std::map<std::array<double, 4>, int> lines;  // in one direction less those in the other
    bool is_complete = true;
    for (std::size_t site = 0; site < set.sites.size(); ++site) {
      const auto& polygons = map.polygons(site, pen);
      is_complete = is_complete && (!polygons.empty() || !map.has_cell(site));
      for (const map::LonLatPolygon& polygon : polygons) {
        for (std::size_t i = 0; i + 1 < polygon.ring.size(); ++i) {
          const LonLat& p = polygon.ring[i];
          const LonLat& q = polygon.ring[i + 1];
          if (is_on_border(p, q)) continue;
          ++lines[{p.lon_deg, p.lat_deg, q.lon_deg, q.lat_deg}];
          --lines[{q.lon_deg, q.lat_deg, p.lon_deg, p.lat_deg}];
        }
      }
    }
    if (!is_complete) continue;  // what is not drawn has lines that nobody has on the other side
    ++num_maps;
    const auto is_alone = [](const auto& line) { return line.second != 0; };
    EXPECT_EQ(std::ranges::count_if(lines, is_alone), 0) << kind.name;
  }
  EXPECT_GT(num_maps, 20U);
}

// Where lines of a face cross, all positions are those of the grid next to them, and faces beside it have others.
bool are_equal_but_for_the_grid(const std::vector<map::LonLatPolygon>& found,
                                const std::vector<map::LonLatPolygon>& expected) {
  return std::ranges::equal(found, expected, [](const auto& polygon, const auto& other) {
    // Rings may begin at any of their positions.
    return polygon.ring.size() == other.ring.size() &&
           std::ranges::all_of(polygon.ring, [&](const LonLat& p) {
             return std::ranges::any_of(other.ring, [&](const LonLat& q) {
               return std::abs(p.lon_deg - q.lon_deg) <= 0x1p-44 &&
                      std::abs(p.lat_deg - q.lat_deg) <= 0x1p-44;
             });
           });
  });
}

TEST(face_map, has_each_face_as_it_is_drawn) {
  for (const std::vector<Point>& sites : sites_of_all_sizes()) {
    const Triangulation triangulation = delaunay(sites);
    const map::FaceMap map(triangulation, {});
    map::FaceMap::Pen pen;
    std::size_t num_other = 0;
    for (Index face = 0; face < triangulation.num_faces(); ++face) {
      if (triangulation.is_ghost(face)) continue;
      const auto expected = drawn_face(triangulation, face);
      if (!are_equal_but_for_the_grid(map.polygons(face, pen), expected)) ++num_other;
    }
    EXPECT_LE(num_other, triangulation.num_faces() / 10);
  }
}

// Loops with corners anywhere, and on a small grid, where lines touch.
TEST(crossing_lines, are_found_in_a_loop_as_in_a_trace) {
  Random random(12);
  int num_crossing = 0;
  for (int turn = 0; turn < 20000; ++turn) {
    const std::size_t size = 3 + static_cast<std::size_t>(turn) % 8;
    std::vector<LonLat> loop;
    map::Trace trace;
    while (loop.size() < size) {
      LonLat position{40 * random.unit(), 40 * random.unit()};
      if (turn % 2 == 0)
        position = {std::floor(position.lon_deg / 8), std::floor(position.lat_deg / 8)};
      if (std::ranges::find(loop, position) != loop.end()) continue;
      loop.push_back(position);
      trace.points.push_back({{}, position});
    }
    const bool crosses = map::has_crossing_lines(loop);
    EXPECT_EQ(crosses, !map::crossing_lines(trace).empty());
    num_crossing += crosses ? 1 : 0;
  }
  EXPECT_GT(num_crossing, 5000);
  EXPECT_LT(num_crossing, 18000);
}

}  // namespace
}  // namespace rondel::test
