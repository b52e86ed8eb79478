// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces in polygons, against the areas of these polygons, which are computed from their sides alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondel/cell_rings.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/regions.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test::of_faces_inside {
namespace {

using Ends = std::array<Index, 2>;
using Ring = std::vector<Index>;

Point at(double lon_deg, double lat_deg) {
  const double lon = lon_deg * std::numbers::pi / 180;
  const double lat = lat_deg * std::numbers::pi / 180;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// Polygons of rings of sites, whose sides are constraints.
struct Scene {
  std::vector<Point> sites;
  CellRings rings;
  std::vector<Ends> constraints;
  CompressedRows<Index> polygons;

  // Appends sites around a center, counterclockwise, and returns their ring.
  Ring around(double lon_deg, double lat_deg, double radius_deg, Index corners) {
    const Point z = at(lon_deg, lat_deg);
    const Point y = at(lon_deg, lat_deg + 90);
    const Point x = {y.y * z.z - y.z * z.y, y.z * z.x - y.x * z.z, y.x * z.y - y.y * z.x};
    Ring ring;
    for (Index k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double radius = radius_deg * std::numbers::pi / 180;
      const double a = std::sin(radius) * std::cos(angle);
      const double b = std::sin(radius) * std::sin(angle);
      const double c = std::cos(radius);
      ring.push_back(static_cast<Index>(sites.size()));
      sites.push_back(
          {a * x.x + b * y.x + c * z.x, a * x.y + b * y.y + c * z.y, a * x.z + b * y.z + c * z.z});
    }
    return ring;
  }
  void add(const std::vector<Ring>& polygon) {
    for (const Ring& ring : polygon) {
      rings.append_ring(ring);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        polygons.values.push_back(static_cast<Index>(constraints.size()));
        constraints.push_back({ring[k], ring[(k + 1) % ring.size()]});
      }
    }
    rings.end_cell();
    polygons.end_row();
  }
  // Appends sites everywhere.
  void add_sites(std::size_t number) {
    Random random(5);
    for (std::size_t i = 0; i < number; ++i) {
      sites.push_back(at(static_cast<double>(random.below(360'000)) / 1000,
                         static_cast<double>(random.below(170'000)) / 1000 - 85));
    }
  }
};

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

double area_of(const ConstrainedTriangulation& result, std::span<const Index> faces) {
  CellRings cells;
  cells.points.assign(result.triangulation.sites().points().begin(),
                      result.triangulation.sites().points().end());
  for (const Index f : faces) {
    cells.append_ring(result.triangulation.faces()[f]);
    cells.end_cell();
  }
  const std::vector<double> found = areas(cells);
  return std::accumulate(found.begin(), found.end(), 0.0);
}

// Expects the area of each polygon, with and without sites that are split.
void expect_areas(Scene scene) {
  scene.rings.points = scene.sites;
  const std::vector<double> expected = areas(scene.rings);
  for (const auto crossings : {ConstraintCrossings::refuse, ConstraintCrossings::split}) {
    const auto result =
        constrained_delaunay(scene.sites, scene.constraints, {.crossings = crossings});
    const auto inside = faces_inside(result, scene.constraints, scene.polygons);
    ASSERT_EQ(inside.size(), expected.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
      EXPECT_TRUE(std::ranges::is_sorted(inside[p]));
      EXPECT_NEAR(area_of(result, inside[p]), expected[p], 1e-11) << "polygon " << p;
    }
  }
}

TEST(faces_inside, polygons_with_holes_and_islands) {
  Scene scene;
  const Ring outer = scene.around(20, 10, 40, 17);
  const Ring hole = scene.around(25, 10, 20, 11);
  const Ring island = scene.around(24, 12, 8, 5);
  scene.add({outer, reversed(hole), island});
  scene.add({hole, reversed(island)});
  scene.add({island});
  scene.add({outer});
  scene.add_sites(300);
  expect_areas(scene);
}

TEST(faces_inside, polygons_around_poles_and_across_the_antimeridian) {
  Scene scene;
  scene.add({scene.around(0, 90, 20, 8)});
  scene.add({scene.around(0, -90, 30, 3)});
  scene.add({scene.around(180, 0, 15, 9)});
  scene.add_sites(200);
  expect_areas(scene);
}

TEST(faces_inside, polygons_larger_than_a_hemisphere_and_complements) {
  Scene scene;
  const Ring ring = scene.around(70, -20, 33, 12);
  scene.add({reversed(ring)});
  scene.add({ring});
  const Ring other = scene.around(-100, 40, 25, 6);
  scene.add({reversed(ring), reversed(other)});
  scene.add_sites(100);
  expect_areas(scene);
}

TEST(faces_inside, polygons_that_share_sides_and_touch_in_corners) {
  Scene scene;
  const Ring ring = scene.around(0, 0, 30, 8);
  const auto center = static_cast<Index>(scene.sites.size());
  scene.sites.push_back(at(0, 0));
  for (Index k = 0; k < 8; ++k) scene.add({{center, ring[k], ring[(k + 1) % 8]}});
  scene.add({{center, ring[0], ring[1]}, {center, ring[4], ring[5]}});
  scene.add({ring});
  scene.add_sites(150);
  expect_areas(scene);
}

TEST(faces_inside, sites_on_sides_and_duplicates) {
  Scene scene;
  scene.sites = {at(0, 0),  at(30, 0), at(60, 0),  at(0, 90),
                 at(30, 0), at(0, 0),  at(0, -90), at(200, 0)};
  scene.add({{5, 2, 3}});
  scene.add({{0, 4, 3}});
  scene.add({{3, 2, 1, 0}});
  expect_areas(scene);
}

TEST(faces_inside, polygons_that_cross_are_split) {
  Scene scene;
  scene.add({scene.around(0, 0, 20, 7)});
  scene.add({scene.around(15, 5, 20, 9)});
  scene.add_sites(200);
  scene.rings.points = scene.sites;
  const std::vector<double> expected = areas(scene.rings);
  const auto result = constrained_delaunay(scene.sites, scene.constraints,
                                           {.crossings = ConstraintCrossings::split});
  EXPECT_GT(result.triangulation.num_sites(), scene.sites.size());
  const auto inside = faces_inside(result, scene.constraints, scene.polygons);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(area_of(result, inside[p]), expected[p], 1e-11);
  }
}

TEST(faces_inside, a_region_has_its_hull_alone) {
  Scene scene;
  const Ring outer = scene.around(0, 50, 20, 12);
  const Ring inner = scene.around(3, 50, 8, 5);
  scene.add({outer, reversed(inner)});
  expect_areas(scene);
  scene.add({reversed(inner)});
  const auto result = constrained_delaunay(scene.sites, scene.constraints);
  EXPECT_EQ(thrown_message<InvalidInput>(
                [&] { return faces_inside(result, scene.constraints, scene.polygons); }),
            "polygon 1 leaves the hull of the sites, outside of which there are no faces; one more "
            "site there, such as a pole, makes some");
}

TEST(faces_inside, both_hemispheres_and_no_faces) {
  Scene scene;
  const Ring equator = scene.around(0, 90, 90, 6);
  scene.add({equator});
  const auto flat = constrained_delaunay(std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}},
                                         std::vector<Ends>{{0, 1}});
  const std::vector<Ends> there_and_back = {{0, 1}, {1, 2}, {2, 1}, {1, 0}};
  CompressedRows<Index> one;
  one.append(std::array<Index, 4>{0, 1, 2, 3});
  EXPECT_EQ(faces_inside(constrained_delaunay(flat.triangulation.sites(), there_and_back),
                         there_and_back, one)[0]
                .size(),
            0U);
  // A hemisphere, with no site off its border.
  const std::vector<Ends> around = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto half = constrained_delaunay(
      std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, around);
  ASSERT_EQ(half.triangulation.dimension(), 1);
  EXPECT_EQ(thrown_message<InvalidInput>([&] { return faces_inside(half, around, one); }),
            "polygon 0 leaves the hull of the sites, outside of which there are no faces; one more "
            "site there, such as a pole, makes some");
  scene.add({reversed(equator)});
  scene.add_sites(60);
  expect_areas(scene);
}

TEST(faces_inside, sides_that_are_no_rings_are_refused) {
  Scene scene;
  const Ring ring = scene.around(0, 0, 20, 6);
  scene.add({ring});
  scene.polygons.values.pop_back();
  scene.polygons.offsets.back() -= 1;
  scene.add_sites(50);
  const auto result = constrained_delaunay(scene.sites, scene.constraints);
  const auto message = [&] {
    return thrown_message<InvalidInput>(
        [&] { return faces_inside(result, scene.constraints, scene.polygons); });
  };
  EXPECT_EQ(message(), "polygon 0 has sides that close no ring");
  scene.polygons.values[0] = 6;
  EXPECT_EQ(message(), "polygon 0 has constraint 6, but there are 6 constraints");
  scene.constraints.push_back({0, 40});
  EXPECT_EQ(message(), "constraint 6 is no chain of edges");
}

TEST(faces_inside, rings_with_the_interior_on_both_sides_are_refused) {
  Scene scene;
  scene.add({scene.around(0, 0, 20, 6), scene.around(0, 0, 10, 6)});
  scene.add_sites(50);
  const auto result = constrained_delaunay(scene.sites, scene.constraints);
  EXPECT_EQ(thrown_message<InvalidInput>(
                [&] { return faces_inside(result, scene.constraints, scene.polygons); }),
            "polygon 0 has sides that do not divide in and out");
}

}  // namespace
}  // namespace rondel::test::of_faces_inside
