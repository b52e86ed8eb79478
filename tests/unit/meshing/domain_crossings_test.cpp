// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles of domains whose coasts cross each other and the border of the area, at random places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "rondel/mesh_triangles.h"
#include "rondel/set_operations.h"
#include "unit/meshing/domains.h"

namespace rondel::test {
namespace {

// A polygon around a place, whose corners are between two distances from it; deterministic.
Ring rough_ring(std::mt19937& random, double lon, double lat, double radius, double least,
                int size) {
  Ring ring;
  for (int k = 0; k < size; ++k) {
    const double at = radius * (least + (1 - least) * 0x1p-32 * static_cast<double>(random()));
    const double angle = 2 * std::numbers::pi * k / size;
    ring.push_back({lon + at * std::cos(angle), lat + at * std::sin(angle)});
  }
  return ring;
}

// Some polygons of land in and around a sea from -4 to 4 degrees, many of which cross.
std::vector<Geometries> rough_land(std::mt19937& random, std::size_t most, double least, int size) {
  std::vector<Geometries> land;
  const auto place = [&] { return -5 + 10 * 0x1p-32 * static_cast<double>(random()); };
  for (std::size_t k = 1 + random() % most; k > 0; --k) {
    const double lon = place();
    const double lat = place();
    const double radius = 1.2 + 1.8 * 0x1p-32 * static_cast<double>(random());
    land.push_back(polygon({rough_ring(random, lon, lat, radius, least, size)}));
  }
  return land;
}

TEST(domain_crossings, the_order_of_features_changes_nothing_of_narrow_water) {
  const Geometries sea = polygon({box(-4, -4, 4, 4)});
  std::mt19937 random(1);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(round);
    std::vector<Geometries> land = rough_land(random, 6, 0.6, round % 2 == 0 ? 9 : 30);
    TrianglesOptions options = spaced(1);
    options.tolerance.reset();
    options.fill_narrow = 0.5;
    options.smallest_part = round % 3 == 0 ? 1 : 0;
    const DomainTriangles one = triangles({land, {sea}, {}}, options);
    std::ranges::shuffle(land, random);
    expect_same(one, triangles({land, {sea}, {}}, options));
  }
  // The new coast is a loop that begins at one of several sites.
  const Geometries smooth =
      polygon({{{4.096, 2.33}, {2.789, 4.005}, {0.741, 3.412}, {0.779, 1.511}, {2.902, 1.051}}});
  const Geometries rough = polygon(
      {{{5.457, -0.557}, {5.418, -0.322}, {5.372, -0.069}, {5.432, 0.216},  {4.942, 0.188},
        {4.948, 0.786},  {4.412, 0.568},  {4.452, 0.931},  {4.277, 0.926},  {3.954, 0.906},
        {3.663, 0.893},  {3.403, 0.633},  {3.284, 1.173},  {2.835, 0.527},  {2.592, 0.974},
        {2.742, 0.584},  {2.622, 0.428},  {2.543, 0.322},  {2.417, -0.141}, {1.758, -0.306},
        {2.13, -0.557},  {2.045, -0.793}, {2.168, -1.006}, {2.395, -1.127}, {2.488, -1.613},
        {2.302, -1.662}, {2.54, -1.851},  {2.96, -1.97},   {3.137, -2.411}, {3.359, -2.038},
        {3.663, -1.976}, {3.945, -2.251}, {4.093, -2.436}, {4.35, -1.803},  {4.399, -2.099},
        {4.603, -1.618}, {5.243, -1.513}, {4.754, -1.28},  {5.427, -0.944}, {4.943, -0.806}}});
  const Geometries bay = polygon({box(-5, -5, 5, 5)});
  TrianglesOptions options = spaced(1);
  options.tolerance.reset();
  options.fill_narrow = 0.5;
  expect_same(triangles({{smooth, rough}, {bay}, {}}, options),
              triangles({{rough, smooth}, {bay}, {}}, options));
}

// Returns how many chains of the border follow the area: as many as there are nodes where they begin.
std::size_t number_of_open_chains(const DomainTriangles& made) {
  std::vector<int> num_area(made.mesh.nodes.size());
  std::vector<int> num_coast(made.mesh.nodes.size());
  for (std::size_t e = 0; e < made.features.size(); ++e) {
    for (const Index node : made.mesh.edges[e]) {
      num_area[node] += made.features[e] == FeatureOfEdge::area ? 1 : 0;
      num_coast[node] += made.features[e] == FeatureOfEdge::coast ? 1 : 0;
    }
  }
  std::size_t num_ends = 0;
  for (std::size_t v = 0; v < num_area.size(); ++v) {
    if (num_area[v] > 0 && num_coast[v] > 0) ++num_ends;
  }
  return num_ends;
}

TEST(domain_crossings, coasts_leave_the_area_where_they_did) {
  const Geometries sea = polygon({box(-4, -4, 4, 4)});
  std::mt19937 random(2);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(round);
    const MeshDomain domain = {rough_land(random, 4, 0.93, round % 2 == 0 ? 20 : 150), {sea}, {}};
    TrianglesOptions options = spaced(1);
    const std::size_t number = number_of_open_chains(triangles(domain, options));
    options.tolerance.reset();
    EXPECT_EQ(number_of_open_chains(triangles(domain, options)), number);
  }
  // A coast just north of the border, which it leaves in the west.
  const Ring land = {{-3, -3}, {11, -3}, {11, 0.03}, {-0.5, 0.03}, {-3, -0.25}};
  const DomainTriangles made =
      triangles({{polygon({land})}, {polygon({box(-2, 0, 10, 8)})}, {}}, [] {
        TrianglesOptions options = spaced(1);
        options.tolerance.reset();
        return options;
      }());
  double length = 0;
  for (std::size_t e = 0; e < made.features.size(); ++e) {
    if (made.features[e] != FeatureOfEdge::coast) continue;
    const Point& p = made.mesh.nodes[made.mesh.edges[e][0]];
    const Point& q = made.mesh.nodes[made.mesh.edges[e][1]];
    length += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) * 180 / std::numbers::pi;
  }
  EXPECT_NEAR(length, 10.77, 0.1);
}

TEST(domain_crossings, coasts_that_overlap_are_one) {
  const Geometries sea = polygon({box(-4, -4, 4, 4)});
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const std::vector<Geometries> land = rough_land(random, 4, 0.8, 60);
    Geometries all;
    for (const Geometries& one : land) {
      std::vector<Index> ring(one.polygons.corners.size());
      std::iota(ring.begin(), ring.end(), static_cast<Index>(all.polygons.points.size()));
      all.polygons.append_ring(ring);
      all.polygons.points.insert(all.polygons.points.end(), one.polygons.points.begin(),
                                 one.polygons.points.end());
      all.polygons.end_cell();
    }
    Geometries united = polygon({});
    united.polygons = unite(all.polygons);
    TrianglesOptions options = spaced(1);
    options.tolerance.reset();
    const DomainTriangles one = triangles({land, {sea}, {}}, options);
    const DomainTriangles other = triangles({{united}, {sea}, {}}, options);
    EXPECT_EQ(places_of(one), places_of(other));
  }
}

// Returns the number of parts of a mesh without a common edge.
std::size_t number_of_parts(const DomainTriangles& made) {
  std::map<std::array<Index, 2>, std::vector<std::size_t>> at_edge;
  for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::minmax(made.mesh.triangles[t][k], made.mesh.triangles[t][(k + 1) % 3]);
      at_edge[{low, high}].push_back(t);
    }
  }
  std::vector<std::size_t> parts(made.mesh.triangles.size());
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const auto& [edge, at] : at_edge) {
      const std::size_t least = std::min(parts[at.front()], parts[at.back()]);
      is_changed = is_changed || parts[at.front()] != least || parts[at.back()] != least;
      parts[at.front()] = parts[at.back()] = least;
    }
  }
  return std::set(parts.begin(), parts.end()).size();
}

TEST(domain_crossings, one_part_is_left_where_nodes_are_filled) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE(round);
    TrianglesOptions options = spaced(round % 2 == 0 ? 1 : 2);
    options.tolerance.reset();
    options.fill_narrow = round % 4 < 2 ? 0.1 : 0.3;
    options.smallest_part = 1;
    const std::vector<Geometries> land = rough_land(random, 8, 0.4, round % 3 == 0 ? 4 : 6);
    EXPECT_EQ(number_of_parts(triangles({land, {sea}, {}}, options)), 1U);
  }
  std::vector<Geometries> land;
  for (const Ring& ring :
       std::vector<Ring>{{{1, 0}, {-0.5, 1}, {-2, 0}, {-0.5, -1.5}},
                         {{2, -4}, {0, -2.5}, {-1, -4}, {0, -5}},
                         {{2.5, -3.5}, {0, -2}, {-0.5, -5}},
                         {{1.5, -1}, {1, -0.5}, {0, 0}, {-1.5, -1}, {-0.5, -2.5}, {1, -2}},
                         {{4, 2}, {4, 3.5}, {2.5, 3.5}, {2.5, 2}, {2.5, 0.5}, {4, 0}},
                         {{2.5, 0}, {2, 0}, {2.5, -0.5}},
                         {{4.5, -3.5},
                          {4.5, -3},
                          {4.5, -2.5},
                          {4, -2.5},
                          {3.5, -2},
                          {3.5, -1.5},
                          {3, -2},
                          {2.5, -3},
                          {2, -3},
                          {2, -3.5},
                          {2, -4},
                          {2.5, -4},
                          {3, -4.5},
                          {3.5, -5},
                          {4, -4},
                          {4.5, -5},
                          {5, -4}},
                         {{3.5, -1.5}, {2.5, -0.5}, {2, -1.5}, {2.5, -2}}}) {
    land.push_back(polygon({ring}));
  }
  TrianglesOptions options = spaced(2);
  options.tolerance.reset();
  options.fill_narrow = 0.1;
  options.smallest_part = 1;
  const DomainTriangles made = triangles({land, {sea}, {}}, options);
  EXPECT_EQ(number_of_parts(made), 1U);
  EXPECT_EQ(made.num_small_parts, 2U);
}

// Lines that cross in one place up to rounding have one node there, and with a weld those that cross
// nearly in one place, too.
TEST(domain_crossings, lines_through_one_place_have_one_node) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  std::mt19937 random(2);
  const auto in_turn = [&] {
    return 2 * std::numbers::pi * 0x1p-32 * static_cast<double>(random());
  };
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    const double apart = round % 2 == 0 ? 0 : 0.001;
    std::vector<Geometries> lines;
    const double first = in_turn();
    for (int k = 0; k < 3; ++k) {
      const double angle = first + std::numbers::pi / 3 * k;
      const double lon = apart * k;
      lines.push_back(line({{lon + 3 * std::cos(angle), 3 * std::sin(angle)},
                            {lon - 3 * std::cos(angle), -3 * std::sin(angle)}}));
    }
    TrianglesOptions options = spaced(1);
    if (round % 2 == 1) options.weld = 0.02 * std::numbers::pi / 180;
    EXPECT_GT(shortest_edge(triangles({{}, {sea}, lines}, options)), 0.3);
  }
}

// Rivers that cross each other beside a coast, which they cross, too, at any angle.
TEST(domain_crossings, crossings_of_rivers_beside_a_coast_are_welded) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  const Geometries land = polygon({box(-3, -3, 3, 0)});
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    std::vector<Geometries> lines;
    for (int k = 0; k < 2; ++k) {
      const double angle = 0.6 + 1.2 * k + 0.4 * 0x1p-32 * static_cast<double>(random());
      lines.push_back(line({{-2 * std::cos(angle), 0.001 - 2 * std::sin(angle)},
                            {2 * std::cos(angle), 0.001 + 2 * std::sin(angle)}}));
    }
    TrianglesOptions options = spaced(1);
    options.weld = 0.05 * std::numbers::pi / 180;
    options.tolerance = round % 2 == 0 ? 0 : 0.25 * std::numbers::pi / 180;
    EXPECT_GT(shortest_edge(triangles({{land}, {sea}, lines}, options)), 0.3);
  }
}

// Corners of a coast that poke over the border of the sea, however little, sharp ones and blunt ones.
TEST(domain_crossings, corners_that_cross_a_border_are_welded) {
  const Geometries sea = polygon({box(-5, -5, 5, 5)});
  std::mt19937 random(4);
  const auto unit = [&] { return 0x1p-32 * static_cast<double>(random()); };
  constexpr double weld = 0.05;
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    const double over = (round % 2 == 0 ? 1 : -1) * weld * std::pow(10, -4 * unit());
    const double lat = -3 + 6 * unit();
    const double width = round % 3 == 0 ? weld * (1 + 20 * unit()) : 0;
    const Ring land = round % 3 == 0
                          ? Ring{{5 - over, lat},
                                 {5 + weld, lat - width},
                                 {7, lat - 1},
                                 {7, lat + 1},
                                 {5 + weld, lat + width}}
                          : Ring{{5 - over, lat}, {7, lat - 0.1 - unit()}, {7, lat + 0.1 + unit()}};
    TrianglesOptions options = spaced(1);
    options.weld = weld * std::numbers::pi / 180;
    if (round % 4 < 2) options.tolerance.reset();
    EXPECT_GT(shortest_edge(triangles({{polygon({land})}, {sea}, {}}, options)), 0.9 * weld);
  }
}

// Three countries as one data set has them, whose borders cross each other by some centimetres beside a
// needle between them.
TEST(domain_crossings, needles_are_welded) {
  const LonLat tip = {33.96286402485788, 9.464302975197464};
  const Geometries north =
      polygon({{{33.975, 8.685}, {33.965, 9.464}, tip},
               {{33.2, 10.72}, {33.824, 9.484}, tip, {33.961, 9.584}, {34.256, 10.63}}});
  const Geometries east =
      polygon({{{34.256, 10.63}, {33.961, 9.584}, {33.975, 8.685}, {36, 8}, {36, 10.6}}});
  const Geometries south =
      polygon({{{33.975, 8.685}, {33.965, 9.464}, {33.824, 9.484}, {33.2, 10.72}, {31, 8.5}}});
  for (const double weld : {0.02, 0.05, 0.1, 0.18}) {
    SCOPED_TRACE(weld);
    TrianglesOptions options = spaced(2.7);
    options.weld = weld * std::numbers::pi / 180;
    const DomainTriangles made = triangles({{}, {north, east, south}, {}}, options);
    EXPECT_GT(shortest_edge(made), 0.001);  // the needle has a side as short as that
  }
}

TEST(domain_crossings, coasts_that_cross_are_simplified_where_water_is_filled) {
  std::vector<Geometries> land;
  for (const Ring& ring : std::vector<Ring>{
           {{5.5, -2.5}, {6, -1.5},   {5.5, -1.5}, {4, -0.5},   {3.5, -1}, {3, -1},  {2.5, -1.5},
            {2, -0.5},   {1.5, -1.5}, {1, -2},     {1.5, -2.5}, {1, -3.5}, {1, -4},  {1.5, -5},
            {2.5, -5},   {3, -5},     {4, -4.5},   {5, -4.5},   {5, -4},   {6, -3.5}},
           {{5, -1}, {4.5, 0.5}, {3, 0.5}, {2, -1}, {3, -2.5}, {4.5, -2}}}) {
    land.push_back(polygon({ring}));
  }
  TrianglesOptions options = spaced(2);
  options.tolerance.reset();
  options.fill_narrow = 0.5;
  const DomainTriangles made = triangles({land, {polygon({box(-5, -5, 5, 5)})}, {}}, options);
  EXPECT_GT(made.filled_area, 0);
}

}  // namespace
}  // namespace rondel::test
