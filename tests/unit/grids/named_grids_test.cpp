// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Named grids: cells that cover the sphere, areas, numbers and centers that others have published.

#include "rondel/named_grids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "grids/grid_formula.h"
#include "rondel/delaunay.h"
#include "rondel/point_sets.h"
#include "rondel/predicates.h"
#include "rondel/remap.h"
#include "support/generators.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;

std::vector<std::string> small_grids() {
  return {"grid:30",
          "grid:7x5",
          "F8",
          "N32",
          "O1",
          "O2",
          "O16",
          "C1",
          "C2",
          "C7",
          "R1B0",
          "R1B3",
          "R2B2",
          "R3B1",
          "R7B0",
          "hexagons:R1B0",
          "hexagons:R1B3",
          "hexagons:R2B2",
          "hexagons:R3B1",
          "hexagons:R7B0",
          "healpix:0",
          "healpix:0:ring",
          "healpix:1",
          "healpix:2:ring",
          "healpix:4",
          "healpix:5:ring"};
}

TEST(named_grids, cells_cover_the_sphere) {
  for (const std::string& name : small_grids()) {
    for (const GridSides sides : {GridSides::parallels, GridSides::great_circles}) {
      if (name == "grid:7x5" && sides == GridSides::great_circles) continue;
      const NamedGrid grid(name, sides);
      const CellSet cells = grid.cells();
      EXPECT_EQ(cells.num_cells(), grid.num_cells()) << name;
      EXPECT_TRUE(cells.covers_sphere()) << name;
      const auto areas = cells.areas();
      EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), sphere_area, 1e-11) << name;
      EXPECT_EQ(cells.facts().name, name);
      std::uint64_t product = 1;
      for (const std::uint64_t length : grid.shape()) product *= length;
      EXPECT_EQ(product, grid.num_cells()) << name;
    }
  }
}

// Each center is to the left of each side that is an arc, up to the bulge of a chain.
TEST(named_grids, centers_are_in_their_cells) {
  for (const std::string& name : small_grids()) {
    const CellSet cells = NamedGrid(name, GridSides::great_circles).cells();
    if (name == "grid:30" || name == "grid:7x5") continue;
    const CellRings rings = cells.rings();
    const std::vector<LonLat> centers = NamedGrid(name).centers();
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const Point center = unit_vector(centers[i]);
      const auto ring = rings.corners_of(rings.cells[i]);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point& from = rings.points[ring[k]];
        const Point& to = rings.points[ring[(k + 1) % ring.size()]];
        EXPECT_EQ(orientation(from, to, center), Sign::positive) << name << ' ' << i;
      }
    }
  }
}

TEST(named_grids, pixels_have_equal_areas) {
  for (const unsigned order : {0U, 1U, 2U, 3U, 4U, 6U}) {
    const NamedGrid grid("healpix:" + std::to_string(order));
    const CellSet cells = grid.cells();
    const double wanted = sphere_area / static_cast<double>(grid.num_cells());
    double worst = 0;
    for (const double area : cells.areas()) worst = std::max(worst, std::abs(area / wanted - 1));
    EXPECT_LT(worst, 4 * 2.3e-16) << order;
    // Polygons of their corners, without what is known of the areas, have them but for rounding of corners.
    worst = 0;
    const CellSet polygons = CellSet::polygons(cells.rings());
    for (const double area : polygons.areas()) worst = std::max(worst, std::abs(area / wanted - 1));
    EXPECT_LT(worst, 1e-13 * static_cast<double>(1U << order) + 1e-12) << order;
    const WeightFile file = weight_file(remap(NamedGrid("grid:20").cells(), cells, {.order = 1}));
    for (const double area : file.target.areas) EXPECT_LT(std::abs(area / wanted - 1), 4 * 2.3e-16);
  }
}

// The corners of a pixel's chain are within a small part of its width of the curves
// |z| = 1 - j^2 / 3 and the like: those between corners are moved only.
TEST(named_grids, pixels_of_both_orders_are_the_same) {
  for (const unsigned order : {0U, 1U, 3U}) {
    const std::string name = "healpix:" + std::to_string(order);
    std::set<std::vector<std::tuple<double, double, double>>> both[2];
    for (const int k : {0, 1}) {
      const CellRings rings = NamedGrid(k == 0 ? name : name + ":ring").cells().rings();
      for (std::size_t i = 0; i < rings.num_cells(); ++i) {
        std::vector<std::tuple<double, double, double>> corners;
        for (const Index c : rings.corners_of(rings.cells[i])) {
          const Point& p = rings.points[c];
          corners.emplace_back(p.x + 0.0, p.y + 0.0, p.z + 0.0);
        }
        both[k].insert(corners);
      }
    }
    EXPECT_EQ(both[0], both[1]);
    EXPECT_EQ(both[0].size(), NamedGrid(name).num_cells());
  }
}

void expect_centers(const std::string& name, const std::vector<Point>& points) {
  const std::vector<LonLat> centers = NamedGrid(name).centers();
  ASSERT_EQ(centers.size(), points.size()) << name;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point center = unit_vector(centers[i]);
    const Point step{center.x - points[i].x, center.y - points[i].y, center.z - points[i].z};
    EXPECT_LT(std::hypot(step.x, step.y, step.z), 1e-15) << name << ' ' << i;
  }
}

TEST(named_grids, centers_are_the_point_sets) {
  expect_centers("healpix:3:ring", mesh::healpix_points(8));
  expect_centers("O8", mesh::reduced_gaussian_points(8));
  expect_centers("C5", mesh::cubed_sphere_points(5));
}

// Numbers of points that ECMWF, Gorski et al. and ICON's documentation give.
TEST(named_grids, have_published_numbers_of_cells) {
  const std::map<std::string, std::size_t> numbers = {
      {"N32", 6114},    {"N80", 35718},           {"N320", 542080},    {"N640", 2140702},
      {"O320", 421120}, {"O1280", 6599680},       {"F320", 819200},    {"healpix:10", 12582912},
      {"R2B4", 20480},  {"hexagons:R2B4", 10242}, {"R2B10", 83886080}, {"R3B7", 2949120},
      {"C384", 884736}, {"grid:0.01", 648000000}};
  for (const auto& [name, number] : numbers) EXPECT_EQ(NamedGrid(name).num_cells(), number) << name;
}

TEST(named_grids, names_are_told_from_files) {
  for (const char* name :
       {"grid:1", "healpix:x", "N7", "O1", "F5", "C3", "R2B4", "hexagons:2", "tripolar:x"}) {
    EXPECT_TRUE(NamedGrid::is_name(name)) << name;
  }
  for (const char* name : {"", "N", "N3.nc", "R2", "R2B", "RB4", "grid", "C3.csv", "healpix", "n32",
                           "hexagons", "tripolar"}) {
    EXPECT_FALSE(NamedGrid::is_name(name)) << name;
  }
}

TEST(named_grids, pixels_say_what_they_are) {
  const GridMapping mapping = NamedGrid("healpix:5:ring").mapping();
  EXPECT_EQ(mapping.texts[1], (std::pair<std::string, std::string>("indexing_scheme", "ring")));
  EXPECT_EQ(mapping.numbers[0], (std::pair<std::string, double>("refinement_level", 5)));
  EXPECT_EQ(mapping.numbers[1], (std::pair<std::string, double>("healpix_nside", 32)));
  EXPECT_TRUE(NamedGrid("grid:10").mapping().texts.empty());
  for (const char* const name : {"O8", "N32", "F4", "C3", "R2B1", "hexagons:R2B1", "tripolar:10",
                                 "healpix:2:nested", "healpix:0:ring"}) {
    EXPECT_EQ(grid_named_by(NamedGrid(name).mapping()), name);
  }
  // Tools for HEALPix had other attributes before CF did.
  EXPECT_EQ(grid_named_by({{{"grid_mapping_name", "healpix"}, {"healpix_order", "nest"}},
                           {{"healpix_nside", 8}}}),
            "healpix:3:nested");
  EXPECT_EQ(grid_named_by({{{"grid_mapping_name", "healpix"}, {"healpix_order", "nest"}},
                           {{"healpix_nside", 7}}}),
            "");
  EXPECT_EQ(grid_named_by({{{grid_attribute, "nothing"}}, {}}), "");
  EXPECT_EQ(grid_named_by({}), "");
}

TEST(named_grids, attributes_of_pixels_have_any_case_of_letters) {
  for (const char* const order : {"NESTED", "Nested", "NEST"}) {
    EXPECT_EQ(grid_named_by({{{"grid_mapping_name", "HEALPix"}, {"healpix_order", order}},
                             {{"healpix_nside", 8}}}),
              "healpix:3:nested");
  }
  EXPECT_EQ(grid_named_by({{{"grid_mapping_name", "healpix"}, {"indexing_scheme", "RING"}},
                           {{"refinement_level", 2}}}),
            "healpix:2:ring");
  EXPECT_EQ(
      grid_named_by({{{"grid_name", "healpix"}, {"indexing_scheme", "nested"}}, {{"level", 2}}}),
      "healpix:2:nested");
  const NamedGrid grid("healpix:2:RING");
  EXPECT_EQ(grid.mapping().texts[1].second, "ring");
  EXPECT_EQ(grid.center(0), NamedGrid("healpix:2:ring").center(0));
}

TEST(named_grids, it_is_told_what_attributes_of_pixels_lack) {
  EXPECT_EQ(lack_of_mapping({}), "");
  EXPECT_EQ(lack_of_mapping(NamedGrid("healpix:2").mapping()), "");
  EXPECT_EQ(lack_of_mapping({{{"grid_mapping_name", "healpix"}}, {{"healpix_nside", 4}}}),
            "indexing_scheme or healpix_order (nested or ring)");
  EXPECT_EQ(lack_of_mapping({{{"grid_mapping_name", "healpix"}}, {{"healpix_nside", 7}}}),
            "refinement_level (0 to 13) or healpix_nside (a power of two up to 8192), and "
            "indexing_scheme or healpix_order (nested or ring)");
}

TEST(named_grids, attributes_of_pixels_that_contradict_each_other_name_none) {
  const auto mapping = [](const char* scheme, const char* order, double level, double side) {
    return GridMapping{
        {{"grid_mapping_name", "healpix"}, {"indexing_scheme", scheme}, {"healpix_order", order}},
        {{"refinement_level", level}, {"healpix_nside", side}}};
  };
  EXPECT_EQ(grid_named_by(mapping("nested", "NEST", 2, 4)), "healpix:2:nested");
  EXPECT_EQ(lack_of_mapping(mapping("nested", "NEST", 2, 4)), "");
  EXPECT_EQ(grid_named_by(mapping("nested", "nested", 1, 4)), "");
  EXPECT_EQ(lack_of_mapping(mapping("nested", "nested", 1, 4)),
            "level that refinement_level = 1 and healpix_nside = 4 agree on");
  EXPECT_EQ(grid_named_by(mapping("nested", "ring", 2, 4)), "");
  EXPECT_EQ(lack_of_mapping(mapping("nested", "ring", 2, 7)),
            "level that refinement_level = 2 and healpix_nside = 7 agree on, and order that "
            "indexing_scheme = nested and healpix_order = ring agree on");
}

TEST(named_grids, some_cells_are_those_of_the_whole) {
  for (const char* const name : {"healpix:2:ring", "healpix:1", "O4", "C3", "tripolar:10"}) {
    const NamedGrid grid(name);
    const CellSet all = grid.cells();
    const std::vector<Index> numbers = {7, 0, 30, 5};
    const CellSet some = grid.cells(numbers);
    ASSERT_EQ(some.num_cells(), 4U) << name;
    std::vector<LonLat> places;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      EXPECT_NEAR(some.areas()[k], all.areas()[numbers[k]], 1e-14) << name;
      places.push_back(grid.center(numbers[k]));
    }
    EXPECT_EQ(some.facts().centers, places) << name;
    EXPECT_EQ(grid.numbers_at(places, 1e-4), numbers) << name;
    places[2].lat_deg += 1e-3;
    EXPECT_TRUE(grid.numbers_at(places, 1e-4).empty()) << name;
    places[2] = places[1];
    EXPECT_TRUE(grid.numbers_at(places, 1e-4).empty()) << name;
  }
  const NamedGrid grid("healpix:1");
  EXPECT_TRUE(NamedGrid("F4").numbers_at(grid.centers(), 1e-4).empty());
  const auto why = [](const char* name, std::vector<Index> numbers) {
    return thrown_message<InvalidInput>([&] { return NamedGrid(name).cells(numbers); });
  };
  EXPECT_EQ(why("healpix:1", {3, 48}), "'healpix:1' has no cell 48");
  EXPECT_EQ(why("healpix:1", {3, 4, 3}), "the cell 3 is there twice");
  EXPECT_EQ(why("F4", {3}), "the cells of 'F4' are between lines");
}

TEST(named_grids, refuse_what_is_none) {
  const auto why = [](const char* name) {
    return thrown_message<InvalidInput>([&] { return NamedGrid(name); });
  };
  EXPECT_EQ(why("N33"),
            "'N33' is no grid: N is one of 32, 48, 64, 80, 96, 128, 160, 200, 256, 320, 400, 512, "
            "640, 1024, 1280, 2000");
  EXPECT_EQ(why("healpix:14"), "'healpix:14' is no grid: the level of HEALPix is from 0 to 13");
  EXPECT_EQ(why("healpix:3:rings"), "'healpix:3:rings' is no grid: the order is nested or ring");
  EXPECT_EQ(
      why("grid:7"),
      "'grid:7' is no grid: grid:DEG divides 180 degrees into equal parts, at most 1000000 of "
      "them, grid:NLONxNLAT has NLON by NLAT cells");
  EXPECT_EQ(why("R2B15"), "'R2B15' is no grid: it has too many cells");
  EXPECT_EQ(why("hexagons:R2B15"), "'hexagons:R2B15' is no grid: it has too many cells");
  for (const char* const name : {"hexagons:", "hexagons:2B2", "hexagons:r2b2", "hexagons:R2B"}) {
    EXPECT_EQ(why(name), "'" + std::string(name) +
                             "' is no grid: hexagons:R2B6 is such a name, with any numbers");
  }
  for (const char* const name :
       {"tripolar:7", "tripolar:40", "tripolar:-1", "tripolar:x", "tripolar:0.001"}) {
    EXPECT_EQ(why(name), "'" + std::string(name) +
                             "' is no grid: tripolar:DEG divides 360 degrees into 12 to 60000 "
                             "columns, a multiple of 4");
  }
  EXPECT_EQ(why("C0"), "'C0' is no grid: the number of cells along a face is from 1 to 20000");
}

// A thread keeps the way to the triangle that it has found last, of whichever grid.
TEST(triangle_grid, has_the_same_cells_in_any_order) {
  const std::vector<std::pair<unsigned, unsigned>> sizes = {{2, 3}, {3, 2}, {2, 2}, {1, 0}, {1, 4}};
  std::vector<std::unique_ptr<grids::GridFormula>> formulas;
  std::vector<std::vector<std::vector<Point>>> rings;
  for (const auto& [root, bisections] : sizes) {
    formulas.push_back(grids::triangle_grid(root, bisections));
    rings.emplace_back();
    for (Index cell = 0; cell < formulas.back()->num_cells(); ++cell) {
      grids::triangle_grid(1, 1)->append_ring(0, rings.back().emplace_back());
      rings.back().back().clear();
      formulas.back()->append_ring(cell, rings.back().back());
    }
  }
  Random random(7);
  std::vector<Point> ring;
  for (int k = 0; k < 20000; ++k) {
    const std::size_t grid = random.below(sizes.size());
    const auto cell = static_cast<Index>(random.below(formulas[grid]->num_cells()));
    // The next cells of the same grid share more or less of the way.
    for (Index next = cell; next < std::min(cell + 3, formulas[grid]->num_cells()); ++next) {
      ring.clear();
      formulas[grid]->append_ring(next, ring);
      ASSERT_EQ(ring, rings[grid][next]) << grid << ' ' << next;
    }
  }
}

}  // namespace
}  // namespace rondel::test
