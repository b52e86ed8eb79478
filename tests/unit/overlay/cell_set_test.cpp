// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a CellSet knows of its cells, and what a remapping and a file of weights make of it.
#include "rondel/cell_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/remap.h"
#include "rondel/weight_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/overlay/planar.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

// A grid of 4 by 2 cells, of which the first one takes no part.
CellSet known_cells() {
  CellFacts facts = CellSet::lonlat_grid(GlobalGrid{4, 2}).facts();
  facts.name = "known.nc";
  facts.mask = {0, 1, 1, 1, 1, 1, 1, 1};
  return CellSet::lonlat_grid(GlobalGrid{4, 2}).with_facts(facts);
}

std::string message_of_refusal(const std::function<void()>& work) {
  return thrown_message<InvalidInput>(work);
}

TEST(overlay_cell_set, no_cells_are_a_set) {
  const CellSet nothing;
  EXPECT_EQ(nothing.num_cells(), 0U);
  EXPECT_FALSE(nothing.covers_sphere());
  EXPECT_TRUE(nothing.places().empty() && nothing.corners().empty());
}

TEST(overlay_cell_set, centers_and_lines_of_a_global_grid_are_rounded_once) {
  const GlobalGrid grid{7, 5};
  const CellSet cells = CellSet::lonlat_grid(grid);
  EXPECT_EQ(cells.facts().shape, (std::vector<std::uint64_t>{5, 7}));
  const std::vector<LonLat> places = cells.places();
  for (std::size_t i = 0; i < 35; ++i) {
    const auto column = static_cast<int>(i % 7);
    const auto row = static_cast<int>(i / 7);
    EXPECT_EQ(places[i].lon_deg, static_cast<double>((2 * column + 1 - 7) * 180) / 7);
    EXPECT_EQ(places[i].lat_deg, static_cast<double>((2 * row + 1 - 5) * 90) / 5);
    EXPECT_NEAR(grid.areas()[i], cells.areas()[i], 1e-15);
  }
  EXPECT_EQ(cells.lines()->lon_deg[3], static_cast<double>((6 - 7) * 180) / 7);
  EXPECT_EQ(cells.lines()->lat_deg.back(), 90);
  EXPECT_THROW((void)CellSet::lonlat_grid(GlobalGrid{0, 5}), InvalidInput);
  EXPECT_THROW((void)CellSet::lonlat_grid(GlobalGrid{std::uint64_t{1} << 40, 2}), InvalidInput);
}

TEST(overlay_cell_set, sides_of_a_grid_do_not_change_its_corners) {
  const LonLatGrid lines{{370, 300, 200.5}, {-10, 20, 90}};
  const CellSet flat = CellSet::lonlat_grid(lines);
  const CellSet arcs = CellSet::lonlat_grid(lines, GridSides::great_circles);
  EXPECT_TRUE(flat.has_parallels() && !arcs.has_parallels());
  EXPECT_EQ(flat.places(), arcs.places());
  EXPECT_EQ(flat.places()[1], (LonLat{250.25, 5}));
  ASSERT_EQ(flat.corners(), arcs.corners());
  const std::vector<LonLat> first = {{300, -10}, {370, -10}, {370, 20}, {300, 20}};
  EXPECT_TRUE(std::equal(first.begin(), first.end(), flat.corners().begin()));
}

TEST(overlay_cell_set, cells_of_sites_have_their_centers_of_mass_and_no_corners_for_files) {
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 50, 1));
  EXPECT_EQ(cells.places(), lonlats(cells.centers()));
  EXPECT_TRUE(cells.corners().empty());
  EXPECT_EQ(cells.lines(), nullptr);
}

TEST(overlay_cell_set, cells_that_are_balanced_around_the_center_have_none) {
  for (const double lat : {10.0, 23.4, 66.0, 90.0}) {
    EXPECT_EQ(CellSet::lonlat_grid({{-180, 180}, {-lat, lat}}).centers()[0], Point{}) << lat;
  }
  EXPECT_EQ(CellSet::lonlat_grid({{-180, 180}, {-23.4, 23.5}}).centers()[0].z, 1);
  const Point small = CellSet::lonlat_grid({{0, 1e-4}, {40, 40.0001}}).centers()[0];
  EXPECT_NEAR(lonlats({&small, 1})[0].lat_deg, 40.00005, 1e-6);
}

TEST(overlay_cell_set, facts_have_one_element_for_each_cell) {
  const CellSet cells = CellSet::lonlat_grid(GlobalGrid{4, 2});
  for (const CellFacts& wrong :
       {CellFacts{.centers = {{0, 0}}}, CellFacts{.axes = {{0, 90}, {0, 10}}},
        CellFacts{.mask = {1, 0}}, CellFacts{.shape = {2, 3}},
        CellFacts{.columns = {{"a", true, "1", {1}}}}}) {
    EXPECT_THROW((void)cells.with_facts(wrong), InvalidInput);
  }
  const CellSet told = cells.with_facts({.centers = std::vector<LonLat>(8, {1, 2})});
  EXPECT_EQ(told.places()[7], (LonLat{1, 2}));
  EXPECT_EQ(told.areas().data(), cells.areas().data()) << "the cells are shared";
}

TEST(overlay_cell_set, masks_of_cells_count_unless_the_options_have_others) {
  const CellSet known = known_cells();
  const CellSet fine = CellSet::lonlat_grid(GlobalGrid{8, 4});
  const Remap own = remap(known, fine);
  EXPECT_EQ(own.source_fractions[0], 0);
  const CellSet plain = CellSet::lonlat_grid(GlobalGrid{4, 2});
  EXPECT_EQ(own.weights, remap(plain, fine, {.source_mask = known.facts().mask}).weights);
  const Remap other = remap(known, fine, {.source_mask = {1, 1, 1, 1, 1, 1, 1, 0}});
  EXPECT_EQ(other.source_fractions[0], 1);
  EXPECT_EQ(other.source_fractions[7], 0);
  EXPECT_EQ(other.source.facts().mask.back(), 0);
  EXPECT_EQ(known.facts().mask.back(), 1);
}

TEST(overlay_cell_set, errors_name_the_file_of_the_side) {
  const CellSet twice =
      CellSet::polygons(planar_table({{planar_polygon({planar_box(0, 0, 20, 20)})},
                                      {planar_polygon({planar_box(10, 10, 30, 30)})}})
                            .cells);
  const CellSet named = twice.with_facts({.name = "twice.geojson"});
  const CellSet grid = CellSet::lonlat_grid(GlobalGrid{4, 2});
  const std::string text = message_of_refusal([&] { (void)remap(twice, grid); });
  EXPECT_TRUE(text.starts_with("source cells 0 and 1 overlap")) << text;
  EXPECT_EQ(message_of_refusal([&] { (void)remap(named, grid); }), "twice.geojson: " + text);
  EXPECT_TRUE(message_of_refusal([&] {
                (void)remap(grid, named);
              }).starts_with("twice.geojson: target cells 0 and 1 overlap"));
}

TEST(overlay_cell_set, a_file_of_weights_has_the_facts_of_both_sides) {
  const TemporaryDirectory directory;
  const Remap found = remap(known_cells(), CellSet::lonlat_grid(GlobalGrid{2, 1}), {.order = 2});
  write_weights(directory.file("w.nc"), found);
  const WeightFile read = read_weights(directory.file("w.nc"));
  EXPECT_EQ(read.weights, found.weights);
  EXPECT_EQ(read.source.mask, found.source.facts().mask);
  EXPECT_EQ(read.source.points, found.source.places());
  EXPECT_EQ(read.source.corners, found.source.corners());
  EXPECT_EQ(read.target.areas, found.target_areas);
  EXPECT_EQ(read.target.shape, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(read.method, "Conservative remapping, second order");
  EXPECT_EQ(read.normalization, "destarea");
}

TEST(overlay_cell_set, polygons_of_a_file_have_their_properties) {
  const TemporaryDirectory directory;
  std::ofstream(directory.file("a.geojson"))
      << R"({"type":"Feature","properties":{"name":"a"},"geometry":{"type":"Polygon",)"
      << R"("coordinates":[[[0,0],[9,0],[9,9],[0,0]]]}})";
  const CellSet cells = CellSet::read(directory.file("a.geojson"));
  EXPECT_EQ(cells.facts().name, directory.file("a.geojson"));
  ASSERT_EQ(cells.facts().columns.size(), 1U);
  EXPECT_EQ(cells.facts().columns[0].text, "a");
  EXPECT_THROW((void)CellSet::read(directory.file("none.nc")), FileError);
}

}  // namespace
}  // namespace rondel::test
