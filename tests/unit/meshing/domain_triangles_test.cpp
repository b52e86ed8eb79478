// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Domains filled with triangles: their areas against those of polygons, and what edges follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

#include "inputs/random.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_triangles.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "rondel/remap.h"
#include "rondel/sites.h"
#include "support/thrown.h"
#include "unit/meshing/domains.h"

namespace rondel::test {
namespace {

constexpr double whole_sphere = 4 * std::numbers::pi;

Ring around_pole(double lat) {
  Ring ring;
  for (int k = 0; k < 12; ++k) ring.push_back({30.0 * k, lat});
  return ring;
}

double area_of(const Geometries& geometries) { return areas(geometries.polygons).front(); }

CellRings cells_of(const DomainTriangles& made) {
  CellRings cells;
  cells.points = made.mesh.nodes;
  for (const Triple& triangle : made.mesh.triangles) {
    cells.append_ring(triangle);
    cells.end_cell();
  }
  return cells;
}

double area_of(const DomainTriangles& made) {
  const std::vector<double> found = areas(cells_of(made));
  return std::accumulate(found.begin(), found.end(), 0.0);
}

// Returns the area of what one mesh has and the other one has not, by the pieces in which they overlap.
double area_in_first_alone(const DomainTriangles& first, const DomainTriangles& second) {
  const Remap overlaps =
      remap(CellSet::polygons(cells_of(first)), CellSet::polygons(cells_of(second)));
  double area = 0;
  for (std::size_t i = 0; i < overlaps.source_areas.size(); ++i) {
    area += overlaps.source_areas[i] * (1 - overlaps.source_fractions[i]);
  }
  return area;
}

std::size_t number_of(const DomainTriangles& made, FeatureOfEdge feature) {
  return static_cast<std::size_t>(std::ranges::count(made.features, feature));
}

TEST(domain_triangles, a_sea_with_an_island) {
  const Geometries sea = polygon({box(-5, -4, 6, 5)});
  const Geometries island = polygon({box(1, 1, 2, 3)});
  const DomainTriangles made = triangles({{island}, {sea}, {}}, spaced(1));
  EXPECT_NEAR(area_of(made), area_of(sea) - area_of(island), 1e-13);
  EXPECT_GT(number_of(made, FeatureOfEdge::coast), 5U);
  EXPECT_GT(number_of(made, FeatureOfEdge::area), 30U);
  EXPECT_EQ(number_of(made, FeatureOfEdge::none) + number_of(made, FeatureOfEdge::line), 0U);
  EXPECT_EQ(made.features.size(), made.mesh.edges.size());
}

TEST(domain_triangles, poles_and_the_antimeridian) {
  const Geometries cap = polygon({around_pole(80)});
  const Geometries island = polygon({{{175, -10}, {-175, -10}, {-175, 10}, {175, 10}}});
  const DomainTriangles made = triangles({{cap, island}, {}, {}}, spaced(8));
  EXPECT_NEAR(area_of(made), whole_sphere - area_of(cap) - area_of(island), 1e-11);
  EXPECT_EQ(number_of(made, FeatureOfEdge::coast), made.features.size());
}

TEST(domain_triangles, one_island_in_the_ocean) {
  const Geometries island = polygon({box(10, 10, 12, 12)});
  const DomainTriangles made = triangles({{island}, {}, {}}, {});
  EXPECT_NEAR(area_of(made), whole_sphere - area_of(island), 1e-11);
  EXPECT_EQ(made.mesh.report.num_too_small, 0U);
}

// Corners of an icosahedron fill what is beyond the hull of the features. One of them is where the
// meridian of 36 degrees and the parallel of -26.57 meet, others are the poles.
TEST(domain_triangles, one_island_beside_a_corner_of_an_icosahedron) {
  for (const double apart : {0.0, 1e-14, 1e-12, 1e-6, 1e-3, 0.1}) {
    for (const Ring& ring :
         {box(36 + apart, -30, 46, -20), Ring{{0, 80}, {90, 80}, {180 - apart, 80}}}) {
      SCOPED_TRACE(std::to_string(apart) + ' ' + std::to_string(ring[0].lat_deg));
      const Geometries island = polygon({ring});
      const DomainTriangles made = triangles({{island}, {}, {}}, spaced(9));
      EXPECT_NEAR(area_of(made), whole_sphere - area_of(island), 1e-11);
      double shortest = 4;
      for (const auto& [a, b, c] : made.mesh.triangles) {
        for (const auto& [p, q] : {std::array{a, b}, {b, c}, {c, a}}) {
          const Point& from = made.mesh.nodes[p];
          const Point& to = made.mesh.nodes[q];
          shortest = std::min(shortest, std::hypot(to.x - from.x, to.y - from.y, to.z - from.z));
        }
      }
      EXPECT_GT(shortest, 0.01);
    }
  }
}

TEST(domain_triangles, the_whole_sphere) {
  const DomainTriangles made = triangles({}, spaced(20));
  EXPECT_NEAR(area_of(made), whole_sphere, 1e-11);
  EXPECT_TRUE(made.features.empty());
}

TEST(domain_triangles, lines_are_edges_where_there_is_water) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  const Geometries island = polygon({box(2, -1, 4, 1)});
  const Geometries along = line({{-3, 0}, {3, 0}});
  const Geometries across = line({{0, -3}, {0, 3}});
  const Geometries buoy = line({{-4, 4}});
  const DomainTriangles made = triangles({{island}, {sea}, {along, across, buoy}}, spaced(2));
  std::size_t num_at_crossing = 0;
  std::size_t num_at_buoy = 0;
  const Point at = unit_vectors(Ring{{-4, 4}}).front();
  for (const Point& p : made.mesh.nodes) {
    num_at_crossing += p.x == 1 && p.y == 0 && p.z == 0 ? 1U : 0U;
    num_at_buoy += p == at ? 1U : 0U;
  }
  EXPECT_EQ(num_at_crossing, 1U);
  EXPECT_EQ(num_at_buoy, 1U);
  const Point pole = {0, 0, 1};
  for (std::size_t e = 0; e < made.features.size(); ++e) {
    if (made.features[e] != FeatureOfEdge::line) continue;
    const Point& p = made.mesh.nodes[made.mesh.edges[e][0]];
    const Point& q = made.mesh.nodes[made.mesh.edges[e][1]];
    EXPECT_TRUE((p.z == 0 && q.z == 0) || (p.y == 0 && q.y == 0));
    EXPECT_NE(orientation(p, q, pole) == Sign::zero, p.z == 0 && q.z == 0);
  }
  EXPECT_GT(number_of(made, FeatureOfEdge::line), 5U);
}

TEST(domain_triangles, small_islands_vanish) {
  const Geometries sea = polygon({box(-5, -4, 6, 5)});
  const Geometries rock = polygon({box(1, 1, 1.01, 1.01)});
  TrianglesOptions options = spaced(1);
  const std::size_t num_with_rock = triangles({{rock}, {sea}, {}}, options).mesh.nodes.size();
  options.tolerance.reset();
  const DomainTriangles made = triangles({{rock}, {sea}, {}}, options);
  EXPECT_LT(made.mesh.nodes.size(), num_with_rock);
  EXPECT_EQ(number_of(made, FeatureOfEdge::coast), 0U);
}

TEST(domain_triangles, an_area_without_a_small_island_is_everywhere) {
  Ring rock = box(1, 1, 1.01, 1.01);
  std::ranges::reverse(rock);
  TrianglesOptions options = spaced(20);
  options.tolerance.reset();
  const DomainTriangles made = triangles({{}, {polygon({rock})}, {}}, options);
  EXPECT_NEAR(area_of(made), whole_sphere, 1e-11);
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return triangles({{polygon({rock})}, {}, {}}, options);
            }),
            "nothing is left for triangles: the land covers the area");
}

TEST(domain_triangles, order_and_threads_change_nothing) {
  const Geometries sea = polygon({box(-5, -4, 6, 5)});
  const Geometries east = polygon({box(1, 1, 2, 3)});
  const Geometries west = polygon({box(-3, -2, 0, 1)});
  TrianglesOptions options = spaced(1);
  for (const double share : {0.0, 1.0}) {
    options.fill_narrow = share;
    const DomainTriangles one = triangles({{east, west}, {sea}, {}}, options);
    expect_same(one, triangles({{west, east}, {sea}, {}}, options, {.threads = 2}));
  }
}

// Two boxes share a part of a meridian, with corners of one on a side of the other one, which is an arc
// on the sphere: rounding leaves gaps and overlaps of 1e-16 between them.
TEST(domain_triangles, features_that_touch_are_welded) {
  const Geometries sea = polygon({box(-157.87, 14.7, -149.87, 20.7)});
  const Geometries west = polygon({box(-155.87, 16.7, -153.87, 18.7)});
  const Geometries east = polygon({box(-153.87, 17.9, -152.87, 18.41)});
  TrianglesOptions options = spaced(0.4);
  const DomainTriangles made = triangles({{west, east}, {sea}, {}}, options);
  EXPECT_LT(made.mesh.nodes.size(), 2000U);
  EXPECT_GT(shortest_edge(made), 0.1);
  const DomainTriangles other = triangles({{east, west}, {sea}, {}}, options);
  EXPECT_TRUE(std::ranges::equal(made.mesh.nodes, other.mesh.nodes));
  EXPECT_EQ(made.mesh.triangles, other.mesh.triangles);
  // A line that ends on the side of a box, by positions that are rounded to six decimals.
  const Geometries slanted = polygon({{{-156, 16}, {-155, 16}, {-154.3, 18}, {-156, 18}}});
  const Point& a = slanted.polygons.points[1];
  const Point& b = slanted.polygons.points[2];
  const LonLat middle = lonlats(std::array{Point{a.x + b.x, a.y + b.y, a.z + b.z}}).front();
  const auto rounded = [](double degrees) { return std::round(1e6 * degrees) / 1e6; };
  const Geometries pier = line({{rounded(middle.lon_deg), rounded(middle.lat_deg)}, {-152, 17}});
  options.tolerance.reset();
  const DomainTriangles with_pier = triangles({{slanted}, {sea}, {pier}}, options);
  EXPECT_GT(shortest_edge(with_pier), 0.05);
}

// Borders that were rounded to three decimals have corners beside the sides of their neighbors: there
// are overlaps of 1e-3 degrees, which the mesh fills with triangles as narrow, and gaps, which are
// slits. A distance of 2e-3 degrees closes both.
TEST(domain_triangles, rounded_borders_are_welded) {
  const Ring west = {{0, 0}, {3.1, 0.2}, {3, 2}, {0, 2}};
  const auto east_of = [](double lon_deg) {
    return Ring{{3.1, 0.2}, {6, 0}, {6, 2}, {3, 2}, {lon_deg, 1.1}, {lon_deg + 0.025, 0.65}};
  };
  for (const double lon_deg : {3.049, 3.051}) {
    const Geometries first = polygon({west});
    const Geometries second = polygon({east_of(lon_deg)});
    const Geometries point = line({{3.0562, 1.0}});
    TrianglesOptions options = spaced(0.2);
    options.tolerance.reset();
    options.weld = 2e-3 * std::numbers::pi / 180;
    const DomainTriangles made = triangles({{}, {first, second}, {point}}, options);
    EXPECT_EQ(made.mesh.report.num_near_small_angles, 0U) << lon_deg;
    EXPECT_GT(shortest_edge(made), 0.05) << lon_deg;
    EXPECT_NEAR(area_of(made), area_of(first) + area_of(second), 3e-6);
    const DomainTriangles other = triangles({{}, {second, first}, {point}}, options);
    EXPECT_TRUE(std::ranges::equal(made.mesh.nodes, other.mesh.nodes));
    EXPECT_EQ(made.mesh.triangles, other.mesh.triangles);
    options.weld.reset();
    options.tolerance = 0;
    const DomainTriangles open = triangles({{}, {first, second}, {point}}, options);
    const bool is_overlap = lon_deg < 3.05;
    EXPECT_EQ(shortest_edge(open) < 2e-3, is_overlap);
    EXPECT_EQ(mesh::pinched_nodes(mesh::triangle_mesh(open)).empty(), is_overlap);
    EXPECT_TRUE(mesh::pinched_nodes(mesh::triangle_mesh(made)).empty());
  }
}

// An island that is smaller than the distance has no corners left, and a spike closes.
TEST(domain_triangles, welded_rings_may_vanish) {
  const Geometries sea = polygon({box(0, 0, 4, 4)});
  const Geometries islands = polygon({box(1, 1, 1.01, 1.01), {{2, 2}, {3, 2}, {3, 3}, {2, 3}}});
  TrianglesOptions options = spaced(0.5);
  options.weld = 0.02 * std::numbers::pi / 180;
  const DomainTriangles made = triangles({{islands}, {sea}, {}}, options);
  const Geometries left = polygon({{{2, 2}, {3, 2}, {3, 3}, {2, 3}}});
  EXPECT_NEAR(area_of(made), area_of(sea) - area_of(left), 1e-12);
  for (const double bad : {-1.0, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.weld = bad;
    EXPECT_THROW(triangles({{islands}, {sea}, {}}, options), InvalidInput);
  }
}

// An island with a lake vanishes with it, as coast and as a part of the area.
TEST(domain_triangles, small_islands_with_lakes_vanish) {
  const Geometries sea = polygon({box(0, 0, 10, 8)});
  Ring lake = box(4.05, 4.05, 4.1, 4.1);
  std::ranges::reverse(lake);
  const Geometries island = polygon({box(4, 4, 4.2, 4.2), lake});
  const Geometries beside =
      polygon({box(20, 4, 20.2, 4.2), {{20.05, 4.05}, {20.05, 4.1}, {20.1, 4.1}, {20.1, 4.05}}});
  TrianglesOptions options = spaced(2);
  options.tolerance.reset();
  const double area = area_of(triangles({{}, {sea}, {}}, options));
  EXPECT_EQ(area_of(triangles({{island}, {sea}, {}}, options)), area);
  EXPECT_EQ(area_of(triangles({{}, {sea, beside}, {}}, options)), area);
  EXPECT_NEAR(area_of(triangles({{island}, {}, {}}, options)), whole_sphere, 1e-11);
}

// A weld does not turn a small island inside out, whatever its shape.
TEST(domain_triangles, small_islands_are_not_turned_inside_out) {
  const Geometries sea = polygon({box(-9, -8, 9, 8)});
  inputs::Random random(5);
  TrianglesOptions options = spaced(4);
  options.tolerance.reset();
  const std::size_t expected = triangles({{}, {sea}, {}}, options).mesh.triangles.size();
  const double weld_deg = 1e-4 * 4;
  for (int run = 0; run < 300; ++run) {
    const int size = 4 + run % 7;
    Ring rock;
    for (int k = 0; k < size; ++k) {
      const double angle = 2 * std::numbers::pi * k / size;
      const double radius = weld_deg * (0.5 + 2.5 * random.unit());
      rock.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    Ring lake;
    for (const LonLat& p : rock) lake.insert(lake.begin(), {0.9 * p.lon_deg, 0.9 * p.lat_deg});
    for (const Geometries& island : {polygon({rock}), polygon({rock, lake})}) {
      EXPECT_EQ(triangles({{island}, {sea}, {}}, options).mesh.triangles.size(), expected) << run;
      EXPECT_EQ(triangles({{}, {sea, island}, {}}, options).mesh.triangles.size(), expected) << run;
    }
  }
}

// Small islands vanish also where they touch each other, the land or the border.
TEST(domain_triangles, small_islands_that_touch_vanish) {
  const Geometries sea = polygon({box(-9, -8, 9, 8)});
  const Geometries land = polygon({box(2, 2, 6, 6)});
  TrianglesOptions options = spaced(4);
  options.tolerance.reset();
  const auto number = [&](const std::vector<Geometries>& coast) {
    return triangles({coast, {sea}, {}}, options).mesh.triangles.size();
  };
  const std::size_t without = number({});
  EXPECT_EQ(number({polygon({box(0, 0, 0.1, 0.1)}), polygon({box(0.1, 0, 0.2, 0.1)})}), without);
  EXPECT_EQ(number({polygon({box(0, 0, 0.1, 0.1)}), polygon({box(0.1, 0.1, 0.2, 0.2)})}), without);
  EXPECT_EQ(number({polygon({{{9, 0}, {8.9, 0.1}, {8.9, -0.1}}})}), without);
  EXPECT_EQ(number({land, polygon({box(1.9, 1.9, 2, 2)})}), number({land}));
  EXPECT_EQ(number({land, polygon({box(1.9, 3, 2, 3.1)})}), number({land}));
}

// Strips that overlap are one land, which is wide.
TEST(domain_triangles, overlapping_strips_are_united_before_small_rings_vanish) {
  const Geometries sea = polygon({box(0, 0, 12, 8)});
  std::vector<Geometries> strips;
  for (int k = 0; k < 25; ++k) {
    const double more = k % 2 == 0 ? 0 : 0.1;
    strips.push_back(polygon({box(2 + 0.3 * k, 2 - more, 2.4 + 0.3 * k, 6 + more)}));
  }
  TrianglesOptions options = spaced(2);
  options.tolerance.reset();
  const double land = area_of(polygon({box(2, 2, 9.6, 6)}));
  EXPECT_NEAR(area_of(triangles({strips, {sea}, {}}, options)), area_of(sea) - land, 0.2 * land);
  EXPECT_NEAR(area_of(triangles({{}, strips, {}}, options)), land, 0.2 * land);
}

// A strait of 0.3 degrees stays as wide, although the tolerance is 0.5 degrees.
TEST(domain_triangles, straits_stay_open_and_wide) {
  const Geometries sea = polygon({box(-6, -6, 6, 6)});
  for (const double south : {0.3003, 0.3006, 0.35}) {
    const Geometries land = polygon({{{-7, -7},
                                      {7, -7},
                                      {7, -3},
                                      {2.2, -3},
                                      {2, 0.3},
                                      {0, 0},
                                      {-2, 0.3},
                                      {-2.2, -3},
                                      {-7, -3}}});
    const Geometries island = polygon({{{0, south}, {1.5, 2}, {-1.5, 2}}});
    TrianglesOptions options = spaced(2);
    options.tolerance.reset();
    const DomainTriangles made = triangles({{land, island}, {sea}, {}}, options);
    EXPECT_GT(shortest_edge(made), 0.25);
    EXPECT_TRUE(mesh::pinched_nodes(mesh::triangle_mesh(made)).empty());
  }
}

// Two seas of 10 and 4 degrees, a strait of 0.1 degrees between them, and a fjord of the large one.
MeshDomain seas_with_strait() {
  const Geometries around = polygon({box(-10, -10, 20, 20)});
  Ring shores = {{0, 0},   {10, 0},   {10, 4.95}, {12, 4.95}, {12, 3},
                 {16, 3},  {16, 7},   {12, 7},    {12, 5.05}, {10, 5.05},
                 {10, 10}, {5.1, 10}, {5, 14},    {4.9, 10},  {0, 10}};
  std::ranges::reverse(shores);
  return {{polygon({box(-20, -20, 30, 25), shores})}, {around}, {}};
}

TEST(domain_triangles, lines_outside_are_told) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  const Geometries island = polygon({box(2, -1, 4, 1)});
  const MeshDomain domain = {{island},
                             {sea},
                             {line({{2.5, 0}, {3.5, 0}}),  // on land
                              line({{3, 0}, {3, 3}}),      // from land into the sea
                              line({{7, 0}, {9, 1}}), line({{3, 0}}), line({{4.9, 4.9}}),
                              line({{5.1, 4.9}}), line({{2, -1}, {2, 1}}),  // the coast
                              line({{2, 0}, {3, 0}}),                       // from the coast inland
                              polygon({box(6, 0, 7, 1)}), polygon({})}};
  const std::vector<Index> outside = {0, 2, 3, 5, 7, 8};
  EXPECT_EQ(triangles(domain, spaced(1)).lines_outside, outside);
  TrianglesOptions filled = spaced(1);
  filled.fill_narrow = 0.5;
  EXPECT_EQ(triangles(domain, filled).lines_outside, outside);
  EXPECT_TRUE(triangles({{island}, {sea}, {}}, spaced(1)).lines_outside.empty());
}

TEST(domain_triangles, lines_on_parts_that_are_left_out_are_outside) {
  MeshDomain domain = seas_with_strait();
  domain.lines = {line({{14, 4}, {15, 5}}), line({{10, 4.97}, {12, 5.03}}), line({{3, 3}})};
  TrianglesOptions options = spaced(1);
  EXPECT_TRUE(triangles(domain, options).lines_outside.empty());
  options.fill_narrow = 0.5;
  EXPECT_EQ(triangles(domain, options).lines_outside, std::vector<Index>{1});
  options.smallest_part = 0.5;
  EXPECT_EQ(triangles(domain, options).lines_outside, (std::vector<Index>{0, 1}));
}

TEST(domain_triangles, narrow_water_is_filled) {
  TrianglesOptions options = spaced(1);
  const MeshDomain domain = seas_with_strait();
  const DomainTriangles open = triangles(domain, options);
  EXPECT_LT(shortest_edge(open), 0.11);
  EXPECT_EQ(open.filled_area, 0);
  options.fill_narrow = 0.5;
  const DomainTriangles made = triangles(domain, options);
  EXPECT_GT(shortest_edge(made), 0.25);
  EXPECT_GT(made.filled_area, 0);
  EXPECT_NEAR(made.filled_area, area_in_first_alone(open, made), 1e-13);
  EXPECT_GT(number_of(made, FeatureOfEdge::coast), 0U);
  options.smallest_part = 0.5;
  const DomainTriangles large = triangles(domain, options);
  EXPECT_EQ(large.num_small_parts, 1U);
  EXPECT_NEAR(area_of(large), area_of(polygon({box(0, 0, 10, 10)})), 3e-5);
  options.smallest_part = 0.1;
  EXPECT_EQ(places_of(triangles(domain, options)), places_of(made));
}

// Two countries whose border ends between corners of one of them: the step in their coast is narrow.
// Where it is filled, the new coast is simplified, which takes more land away than was filled.
TEST(domain_triangles, the_filled_area_is_that_of_water_alone) {
  TrianglesOptions options = spaced(2);
  const Geometries sea = polygon({box(-20, 25, 5, 58)});
  const Geometries south = polygon({box(-13.54, 32.5, -1.07, 46)});
  for (const double west : {-13.45, -13.42, -13.4}) {
    const Geometries north = polygon({box(west, 46, -1.62, 50.8)});
    const MeshDomain domain = {{south, north}, {sea}, {}};
    options.fill_narrow = 0;
    const DomainTriangles open = triangles(domain, options);
    options.fill_narrow = 0.3;
    const DomainTriangles made = triangles(domain, options);
    EXPECT_GT(area_of(made), area_of(open)) << west;
    EXPECT_GT(made.filled_area, 0) << west;
    EXPECT_NEAR(made.filled_area, area_in_first_alone(open, made), 1e-13) << west;
  }
}

// A line that ends on a coast divides one of its sides, up to rounding.
TEST(domain_triangles, lines_alone_fill_nothing) {
  TrianglesOptions options = spaced(2);
  options.fill_narrow = 0.1;
  const Geometries sea = polygon({box(-20, 25, 5, 58)});
  const Geometries land = polygon({{{-11, 30}, {-3, 34}, {-6, 47}}});
  for (const double lat : {31.7, 33.3, 40.1}) {
    const DomainTriangles made = triangles({{land}, {sea}, {line({{-19, 26}, {4, lat}})}}, options);
    EXPECT_EQ(made.filled_area, 0) << lat;
  }
}

// Whichever features have them: a line from a side of a land, with a sharp angle between.
TEST(domain_triangles, lines_of_coasts_and_areas_fill_nothing) {
  TrianglesOptions options = spaced(1);
  options.fill_narrow = 0.5;
  const Geometries sea = polygon({box(-9, -8, 9, 8)});
  const Geometries land = polygon({box(-5, -5, -1, 1)});
  const Geometries along = line({{-1, -4}, {0, 0.2}});
  const DomainTriangles made = triangles({{land}, {sea}, {along}}, options);
  EXPECT_EQ(made.filled_area, 0);
  const DomainTriangles of_coast =
      triangles({{together({along, land, along})}, {sea}, {}}, options);
  EXPECT_EQ(of_coast.filled_area, 0);
  EXPECT_EQ(of_coast.mesh.triangles, made.mesh.triangles);
  EXPECT_EQ(number_of(of_coast, FeatureOfEdge::line), 0U);
  const DomainTriangles of_area = triangles({{land}, {together({along, sea})}, {}}, options);
  EXPECT_EQ(of_area.filled_area, 0);
  EXPECT_EQ(of_area.mesh.triangles, made.mesh.triangles);
  // Water that is filled elsewhere changes nothing of that.
  const Geometries near = polygon({box(-5, 1.2, -1, 4)});
  const DomainTriangles filled = triangles({{land, near}, {sea}, {along}}, options);
  const DomainTriangles other = triangles({{together({land, along, near})}, {sea}, {}}, options);
  EXPECT_GT(filled.filled_area, 0);
  EXPECT_EQ(filled.filled_area, other.filled_area);
  EXPECT_EQ(filled.mesh.triangles, other.mesh.triangles);
}

// Two countries with a gap of a centimetre, of a fjord that opens from there, and of some kilometres: no gap costs
// triangles of its width.
TEST(domain_triangles, gaps_are_filled_however_narrow_they_are) {
  TrianglesOptions options = spaced(1);
  options.fill_narrow = 0.5;
  options.refine.most_vertices = 20'000;
  const auto mesh_of = [&](double west, double east) {
    const Geometries north = polygon({{{0, 5 + west}, {10, 5 + east}, {10, 9}, {0, 9}}});
    return triangles({{north, polygon({box(0, 0, 10, 5)})}, {polygon({box(-5, -5, 15, 15)})}, {}},
                     options);
  };
  const DomainTriangles wide = mesh_of(0.1, 0.1);
  for (const double gap : {1e-7, 1e-4, 1e-2}) {
    EXPECT_EQ(mesh_of(gap, gap).mesh.nodes.size(), wide.mesh.nodes.size());
    const DomainTriangles fjord = mesh_of(gap, 3);
    EXPECT_GT(shortest_edge(fjord), 0.25);
    EXPECT_GT(fjord.filled_area, 0);
  }
}

// Islands beside the border of the area, with narrow water between: where it is filled, corners of
// the new coast are on what was one arc, up to rounding.
TEST(domain_triangles, borders_beside_filled_water_are_divided) {
  TrianglesOptions options = spaced(1);
  options.fill_narrow = 0.5;
  const Geometries sea = polygon({box(-10, -10, 10, 10)});
  for (int k = 0; k < 12; ++k) {
    MeshDomain domain = {{}, {sea}, {}};
    for (int i = 0; i < 4; ++i) {
      const double south = -8 + 4 * i + 0.13 * k;
      const double west = -9.9 + 0.07 * ((i * 5 + k) % 9);
      domain.coast.push_back(polygon({box(west, south, west + 1.5 + 0.2 * i, south + 2)}));
    }
    const DomainTriangles made = triangles(domain, options);
    EXPECT_GT(made.filled_area, 0) << k;
    EXPECT_EQ(made.mesh.report.num_too_small, 0U) << k;
    EXPECT_LE(longest_edge(made), 1.5) << k;
    double land = made.filled_area;
    for (const Geometries& island : domain.coast) land += area_of(island);
    EXPECT_NEAR(area_of(made) + land, area_of(sea), 1e-13) << k;
  }
}

TEST(domain_triangles, areas_of_half_of_the_sphere_and_more) {
  const TrianglesOptions options = spaced(20);
  for (const double lat : {-20.0, -0.001, 0.0, 5.0, 60.0}) {
    Ring south = around_pole(lat);
    std::ranges::reverse(south);
    for (const bool is_land : {false, true}) {
      const Geometries part = polygon({is_land ? around_pole(lat) : south});
      MeshDomain domain;
      (is_land ? domain.coast : domain.area).push_back(part);
      const DomainTriangles made = triangles(domain, options);
      EXPECT_NEAR(area_of(made), area_of(polygon({south})), 1e-12) << lat << is_land;
      EXPECT_LE(longest_edge(made), 30) << lat << is_land;
    }
  }
  Geometries everything;
  everything.polygons.whole.push_back(0);
  everything.polygons.end_cell();
  everything.lines.end_group();
  const DomainTriangles made = triangles({{}, {everything}, {}}, options);
  EXPECT_EQ(places_of(made), places_of(triangles({}, options)));
  EXPECT_THROW(triangles({{everything}, {}, {}}, options), InvalidInput);
}

TEST(domain_triangles, areas_and_coasts_have_polygons) {
  const TrianglesOptions options = spaced(20);
  const Geometries shore = line({{0, 0}, {3, 4}});
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              triangles({{}, {shore}, {}}, options);
            }),
            "the area has no polygon");
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              triangles({{}, {Geometries()}, {}}, options);
            }),
            "the area has no polygon");
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              triangles({{shore}, {}, {}}, options);
            }),
            "the coast has no polygon: lines and points are none");
  EXPECT_EQ(places_of(triangles({{Geometries()}, {}, {}}, options)),
            places_of(triangles({}, options)));
}

// A strait of one unit in the last place.
TEST(domain_triangles, straits_of_an_ulp_are_closed) {
  const Geometries west = polygon({box(0, 0, 10, 10)});
  const Geometries east = polygon({box(10.000000000000002, 0, 20, 10)});
  const MeshDomain domain = {{west, east}, {polygon({box(-5, -5, 25, 15)})}, {}};
  for (const double share : {0.0, 0.5}) {
    TrianglesOptions options = spaced(2);
    options.fill_narrow = share;
    const DomainTriangles made = triangles(domain, options);
    EXPECT_GT(shortest_edge(made), 0.5);
    const mesh::TriangleMesh mesh = triangle_mesh(made);
    EXPECT_NO_THROW(require_valid(mesh));
    EXPECT_EQ(mesh.positions.size(), mesh.points.size());
  }
}

TEST(domain_triangles, lines_and_points_stay_where_narrow_water_is_filled) {
  const Geometries along = line({{2, 2}, {8, 2}});
  const Geometries through = line({{8, 5}, {14, 5}});
  const Geometries buoy = line({{4, 4}});
  TrianglesOptions options = spaced(1);
  options.fill_narrow = 0.5;
  MeshDomain domain = seas_with_strait();
  domain.lines = {along, through, buoy};
  const DomainTriangles made = triangles(domain, options);
  const auto has = [&](const LonLat& position) {
    const Point at = unit_vectors(Ring{position}).front();
    return std::ranges::count(made.mesh.nodes, at) == 1;
  };
  EXPECT_TRUE(has({2, 2}) && has({8, 2}) && has({8, 5}) && has({14, 5}) && has({4, 4}));
  double length = 0;
  for (std::size_t e = 0; e < made.features.size(); ++e) {
    if (made.features[e] != FeatureOfEdge::line) continue;
    const Point& p = made.mesh.nodes[made.mesh.edges[e][0]];
    const Point& q = made.mesh.nodes[made.mesh.edges[e][1]];
    length += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) * 180 / std::numbers::pi;
  }
  // Two degrees of the line through the strait are on land.
  EXPECT_GT(length, 9);
  EXPECT_LT(length, 11);
}

TEST(domain_triangles, a_border_across_filled_water_becomes_coast) {
  // Two parts of an area have the mouth of the strait in common.
  MeshDomain domain = seas_with_strait();
  domain.area = {polygon({box(-10, -10, 10, 20)}), polygon({box(10, -10, 20, 20)})};
  TrianglesOptions options = spaced(1);
  EXPECT_GT(number_of(triangles(domain, options), FeatureOfEdge::area), 0U);
  options.fill_narrow = 0.5;
  const DomainTriangles made = triangles(domain, options);
  EXPECT_EQ(number_of(made, FeatureOfEdge::area), 0U);
  EXPECT_EQ(number_of(made, FeatureOfEdge::coast), made.features.size());
}

TEST(domain_triangles, shares_out_of_range) {
  const Geometries sea = polygon({box(-5, -4, 6, 5)});
  TrianglesOptions options = spaced(1);
  options.fill_narrow = 1.5;
  EXPECT_THROW(triangles({{}, {sea}, {}}, options), InvalidInput);
  options.fill_narrow = 0.5;
  options.smallest_part = -1;
  EXPECT_THROW(triangles({{}, {sea}, {}}, options), InvalidInput);
  options.smallest_part = 0;
  options.refine.spacing.reset();
  EXPECT_THROW(triangles({{}, {sea}, {}}, options), InvalidInput);
}

TEST(domain_triangles, all_water_is_narrow) {
  TrianglesOptions options = spaced(3);
  options.fill_narrow = 1;
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return triangles({{}, {polygon({box(0, 0, 20, 0.1)})}, {}}, options);
            }),
            "nothing is left for triangles: all water is narrower than wanted");
}

TEST(domain_triangles, nothing_is_left) {
  const Geometries sea = polygon({box(-5, -4, 6, 5)});
  EXPECT_EQ(thrown_message<InvalidInput>([&] {
              return triangles({{sea}, {sea}, {}}, spaced(1));
            }),
            "nothing is left for triangles: the land covers the area");
}

TEST(domain_triangles, areas_that_the_simplification_removes) {
  const MeshDomain domain = {{}, {polygon({box(0, 0, 1, 0.1)})}, {}};
  TrianglesOptions options = spaced(20);
  const auto message = [&](const MeshDomain& given) {
    return thrown_message<InvalidInput>([&] { return triangles(given, options); });
  };
  EXPECT_EQ(message(domain), "");
  options.tolerance = 0.25;
  EXPECT_EQ(
      message(domain),
      "nothing is left for triangles: the area is nowhere wider than the tolerance with which "
      "it is simplified");
  options.tolerance.reset();
  const std::string by_spacing =
      "nothing is left for triangles: the area is nowhere wider than a quarter of the spacing, "
      "with "
      "which it is simplified unless there is a tolerance";
  EXPECT_EQ(message(domain), by_spacing);
  // Neither coasts that are left nor another small part change that.
  EXPECT_EQ(message({{polygon({box(60, 0, 150, 60)})}, {domain.area[0], domain.area[0]}, {}}),
            by_spacing);
  // Where a part of the area is left, that one is filled.
  EXPECT_EQ(message({{}, {domain.area[0], polygon({box(60, 0, 150, 60)})}, {}}), "");
}

TEST(domain_triangles, spacings_that_ask_for_too_many_nodes) {
  // The estimate is near the number of nodes, and more than allowed are refused before the work.
  const auto number = [](const MeshDomain& domain, TrianglesOptions options, double least) {
    const std::size_t nodes = triangles(domain, options).mesh.nodes.size();
    options.refine.most_vertices = static_cast<std::size_t>(least * static_cast<double>(nodes));
    EXPECT_NE(thrown_message<InvalidInput>([&] {
                return triangles(domain, options);
              }).find("the spacing asks for about "),
              std::string::npos);
    return nodes;
  };
  EXPECT_GT(number({{}, {polygon({box(0, 40, 30, 60)})}, {}}, spaced(1), 0.4), 400U);
  EXPECT_GT(number({}, spaced(4), 0.4), 2000U);
  const auto message = [](const MeshDomain& domain, double degrees) {
    return thrown_message<InvalidInput>([&] { return triangles(domain, spaced(degrees)); });
  };
  EXPECT_EQ(
      message({{}, {polygon({box(0, 0, 10, 10)})}, {}}, 1e-6),
      "the spacing asks for about 1.2e+14 nodes, more than the 715827882 that a mesh may have");
  EXPECT_EQ(
      message({}, 1e-3),
      "the spacing asks for about 4.8e+10 nodes, more than the 715827882 that a mesh may have");
  // A small area may have a spacing that the sphere could not have.
  EXPECT_EQ(message({{}, {polygon({box(0, 0, 0.01, 0.01)})}, {}}, 1e-3), "");
}

TEST(domain_triangles, names_of_features) {
  EXPECT_EQ(name_of(FeatureOfEdge::coast), "coast");
  EXPECT_EQ(name_of(static_cast<FeatureOfEdge>(4)), "");
}

}  // namespace
}  // namespace rondel::test
