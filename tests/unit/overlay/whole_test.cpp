// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A cell that is the whole sphere has no border, and is not the same as a cell of which nothing is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/error.h"
#include "rondel/polygon_files.h"
#include "rondel/regions.h"
#include "support/random.h"
#include "support/temporary_files.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr double sphere = 4 * std::numbers::pi;

CellRings whole_sphere() {
  CellRings cells;
  cells.cells = {0, 0};
  cells.whole = {0};
  return cells;
}

TEST(overlay_whole, the_sphere_has_an_area_and_comes_back) {
  const CellSet sphere_cell = CellSet::polygons(whole_sphere());
  EXPECT_EQ(sphere_cell.areas()[0], sphere);
  EXPECT_TRUE(sphere_cell.covers_sphere());
  EXPECT_EQ(sphere_cell.rings().whole, std::vector<Index>{0});
  EXPECT_EQ(areas(whole_sphere())[0], sphere);
  const CellSet one = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}}));
  EXPECT_EQ(one.rings().whole, std::vector<Index>{0});
  EXPECT_EQ(areas(one.rings())[0], sphere);
}

TEST(overlay_whole, cells_that_cover_it_dissolve_to_it) {
  const CellRings cells = CellSet::voronoi(triangulation_of("uniform", 200, 3)).rings();
  const CellRings joined = dissolve(cells, std::vector<Index>(200, 1), 3);
  EXPECT_EQ(joined.whole, std::vector<Index>{1});
  EXPECT_EQ(areas(joined), (std::vector<double>{0, sphere, 0}));
  EXPECT_EQ(dissolve(joined, std::vector<Index>{0, 0, 0}, 1).whole, std::vector<Index>{0});
  EXPECT_TRUE(dissolve(cells, std::vector<Index>(200, no_index), 1).whole.empty());
}

TEST(overlay_whole, clipping_by_it_changes_nothing) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 300, 4));
  const CellSet all = CellSet::polygons(whole_sphere());
  const CellRings clipped = clip(cells, all);
  EXPECT_TRUE(clipped.whole.empty());
  const std::vector<double> found = areas(clipped);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], cells.areas()[i], 1e-15);
  EXPECT_EQ(clip(all, cells).whole, std::vector<Index>{0});
  EXPECT_EQ(clip(all, all).whole, std::vector<Index>{0});
  const RegionPieces pieces = intersection(all, all);
  ASSERT_EQ(pieces.num_pieces(), 1U);
  EXPECT_EQ(pieces.rings.whole, std::vector<Index>{0});
  EXPECT_EQ(areas(pieces.rings)[0], sphere);
}

// Two halves of the sphere with one border, each a little more than a half by rounding.
TEST(overlay_whole, halves_are_apart) {
  CellRings halves;
  constexpr double angle = 0.4;
  for (int k = 0; k < 5; ++k) {
    const double at = 1.2 * k;
    halves.points.push_back(unit_vector({at * 60, 10 * std::sin(at + angle)}));
  }
  halves.corners = {0, 1, 2, 3, 4, 4, 3, 2, 1, 0};
  halves.rings = {0, 5, 10};
  halves.cells = {0, 1, 2};
  const CellSet cells = CellSet::polygons(halves);
  const RegionPieces pieces = intersection(cells, cells);
  EXPECT_EQ(pieces.num_pieces(), 2U);
  EXPECT_TRUE(pieces.rings.whole.empty());
  const CellSet equator = CellSet::voronoi(delaunay(std::vector<Point>{{0, 0, 1}, {0, 0, -1}}));
  const RegionPieces of_equator = intersection(equator, equator);
  EXPECT_TRUE(of_equator.rings.whole.empty());
}

TEST(overlay_whole, nothing_is_not_the_sphere) {
  CellRings nothing;
  nothing.cells = {0, 0};
  EXPECT_EQ(areas(nothing)[0], 0);
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 30, 5));
  EXPECT_TRUE(clip(CellSet::polygons(nothing), cells).whole.empty());
  EXPECT_TRUE(clip(CellSet::polygons(whole_sphere()), CellSet::polygons(nothing)).whole.empty());
  EXPECT_EQ(intersection(cells, CellSet::polygons(nothing)).num_pieces(), 0U);
}

TEST(overlay_whole, means_over_it_and_from_it) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 100, 6));
  const CellSet all = CellSet::polygons(whole_sphere());
  for (const unsigned order : {1U, 2U}) {
    const Remap to = remap(cells, all, {.order = order});
    std::vector<double> values(100);
    std::iota(values.begin(), values.end(), 1.0);
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) mean += values[i] * cells.areas()[i] / sphere;
    std::vector<double> out(1);
    apply(to.weights, values, out);
    EXPECT_NEAR(out[0], mean, 1e-12);
    const Remap from = remap(all, cells, {.order = order});
    std::vector<double> constant(100);
    apply(from.weights, std::vector<double>{7}, constant);
    for (const double value : constant) EXPECT_NEAR(value, 7, 1e-14);
  }
}

TEST(overlay_whole, a_name_that_does_not_fit_is_refused) {
  CellRings twice = whole_sphere();
  twice.whole = {0, 0};
  EXPECT_THROW((void)CellSet::polygons(twice), InvalidInput);
  CellRings beyond = whole_sphere();
  beyond.whole = {1};
  EXPECT_THROW((void)CellSet::polygons(beyond), InvalidInput);
  CellRings with_rings = CellSet::voronoi(triangulation_of("uniform", 20, 7)).rings();
  with_rings.whole = {3};
  EXPECT_THROW((void)CellSet::polygons(with_rings), InvalidInput);
}

// Polygons with straight sides in longitude and latitude whose corner is a pole: sides that meet there
// lie on each other near the pole. What each polygon has for itself is known in closed form.

constexpr double per_degree = std::numbers::pi / 180;

// A triangle between two lines to a pole, up to a distance from it. Slopes are degrees of longitude
// for each degree of latitude.
struct PoleWedge {
  double west;
  double east;
  double height_deg;
};

// Returns the integral of t sin t up to this distance from the pole: the area for a slope of 1.
double area_to(double height_deg) {
  const double t = height_deg * per_degree;
  return std::sin(t) - t * std::cos(t);
}

// Returns the area that each wedge has outside of those before it.
std::vector<double> areas_of_first(const std::vector<PoleWedge>& wedges) {
  std::vector<double> slopes;
  for (const PoleWedge& wedge : wedges) {
    slopes.push_back(wedge.west);
    slopes.push_back(wedge.east);
  }
  std::ranges::sort(slopes);
  std::vector<double> found(wedges.size());
  for (std::size_t k = 0; k + 1 < slopes.size(); ++k) {
    double covered = 0;
    for (std::size_t i = 0; i < wedges.size(); ++i) {
      const bool has_slopes = wedges[i].west <= slopes[k] && slopes[k + 1] <= wedges[i].east;
      if (!has_slopes || wedges[i].height_deg <= covered) continue;
      found[i] += (slopes[k + 1] - slopes[k]) * (area_to(wedges[i].height_deg) - area_to(covered));
      covered = wedges[i].height_deg;
    }
  }
  return found;
}

std::string polygon_of(const PoleWedge& wedge, double lon, double pole) {
  const double lat = std::copysign(90 - wedge.height_deg, pole);
  const auto position = [](double x, double y) {
    return "[" + std::to_string(x) + "," + std::to_string(y) + "]";
  };
  const std::string start = position(lon + wedge.west * wedge.height_deg, lat);
  return R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
         start + "," + position(lon + wedge.east * wedge.height_deg, lat) + "," +
         position(lon, pole) + "," + start + "]]}}";
}

TEST(overlay_poles, overlapping_polygons_with_a_corner_at_a_pole_have_the_areas_of_the_plane) {
  Random random(20);
  for (int trial = 0; trial < 40; ++trial) {
    const double pole = trial % 2 == 0 ? 90 : -90;
    const auto lon = static_cast<double>(random.below(36)) * 10 - 180;
    std::vector<PoleWedge> wedges;
    std::string text;
    const std::uint64_t count = 2 + random.below(3);
    for (std::uint64_t k = 0; k < count; ++k) {
      const double west = (static_cast<double>(random.below(33)) - 16) / 8;
      const double width = static_cast<double>(1 + random.below(16)) / 8;
      wedges.push_back({west, west + width, 5 * static_cast<double>(1 + random.below(5))});
      text += (k == 0 ? "" : ",") + polygon_of(wedges.back(), lon, pole);
    }
    const std::string path = temporary_path("poles.geojson");
    std::ofstream(path) << R"({"type":"FeatureCollection","features":[)" << text << "]}";
    const CellTable table = read_polygons(path, {.overlap = PolygonOverlap::first});
    const std::vector<double> found = areas(table.cells);
    const std::vector<double> wanted = areas_of_first(wedges);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double own = (wedges[i].east - wedges[i].west) * area_to(wedges[i].height_deg);
      EXPECT_NEAR(found[i], wanted[i], 2e-3 * own) << text;
    }
    // The cells are sound: none crosses itself.
    EXPECT_NO_THROW((void)CellSet::polygons(table.cells).areas()) << text;
    EXPECT_NO_THROW(
        (void)intersection(CellSet::polygons(table.cells), CellSet::polygons(table.cells)))
        << text;
  }
}

}  // namespace
}  // namespace rondel::test
