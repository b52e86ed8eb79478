// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of finite elements, of coupled models, and of curvilinear grids that give the corners of all cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "support/temporary_files.h"
#include "unit/meshing/writer.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

using Doubles = std::vector<double>;

CellTable cells_of_file(const MeshWriter& writer) {
  const std::string path = temporary_path("blocks_") +
                           testing::UnitTest::GetInstance()->current_test_info()->name() + ".nc";
  writer.write(path);
  return read_cells(path);
}

// The corners of a cube, (x, y, z) by the bits of their numbers; the length is that of a model that counts in kilometers.
Doubles coordinates_of_cube(unsigned bit) {
  Doubles values;
  for (unsigned corner = 0; corner < 8; ++corner)
    values.push_back((corner >> bit & 1U) != 0 ? 6371 : -6371);
  return values;
}

// Five sides are elements with four corners, one is two triangles; corners are counted from 1.
void add_blocks(MeshWriter& file) {
  file.add_whole("connect1", {{"num_el_in_blk1", 5}, {"num_nod_per_el1", 4}},
                 {1, 3, 4, 2, 1, 2, 6, 5, 1, 5, 7, 3, 2, 4, 8, 6, 3, 7, 8, 4});
  file.add_whole("connect2", {{"num_el_in_blk2", 2}, {"num_nod_per_el2", 3}}, {5, 6, 8, 5, 8, 7});
}

void expect_cube(const CellTable& table) {
  EXPECT_EQ(table.facts.convention, "Exodus");
  ASSERT_EQ(table.num_cells(), 7U);
  const CellSet cell_set = CellSet::of(table);
  EXPECT_TRUE(cell_set.covers_sphere());
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(cell_set.areas()[i], 4 * std::numbers::pi / (i < 5 ? 6 : 12), 1e-14) << i;
  }
}

TEST(overlay_mesh_blocks, exodus_with_one_array_of_coordinates) {
  MeshWriter file;
  Doubles all;
  for (const unsigned bit : {0U, 1U, 2U}) {
    const Doubles values = coordinates_of_cube(bit);
    all.insert(all.end(), values.begin(), values.end());
  }
  file.add("coord", {{"num_dim", 3}, {"num_nodes", 8}}, all);
  add_blocks(file);
  expect_cube(cells_of_file(file));
}

TEST(overlay_mesh_blocks, exodus_with_an_array_for_each_coordinate) {
  MeshWriter file;
  const MeshWriter::Dimensions nodes = {{"num_nodes", 8}};
  file.add("coordx", nodes, coordinates_of_cube(0));
  file.add("coordy", nodes, coordinates_of_cube(1));
  file.add("coordz", nodes, coordinates_of_cube(2));
  add_blocks(file);
  file.add_whole("edge_type1", {{"num_el_in_blk1", 5}, {"num_nod_per_el1", 4}},
                 {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
  const CellTable table = cells_of_file(file);
  expect_cube(table);
  EXPECT_EQ(table.facts.remarks,
            (std::vector<std::string>{
                "2 sides along parallels (edge_type) are taken for great circles"}));
}

TEST(overlay_mesh_blocks, exodus_without_a_coordinate_of_each_corner_is_refused) {
  MeshWriter file;
  file.add("coordx", {{"num_nodes", 8}}, coordinates_of_cube(0));
  file.add("coordy", {{"num_nodes", 8}}, coordinates_of_cube(1));
  file.add("coordz", {{"seven", 7}}, Doubles(7, 1.0));
  add_blocks(file);
  EXPECT_THROW((void)cells_of_file(file), FileError);
}

// Two tiles with 3 x 2 cells: the corners of a tile in one array, and four of each cell, give the same cells.
TEST(overlay_mesh_blocks, corners_of_all_cells_of_tiles) {
  const MeshWriter::Dimensions cells = {{"tile", 2}, {"y", 2}, {"x", 3}};
  const auto lon_of = [](double tile, double y, double x) { return 20 + 90 * tile + 10 * x + y; };
  const auto lat_of = [](double tile, double y, double x) { return 5 * tile - 8 + 7 * y + x / 2; };
  Doubles lon, lat, lon_of_all, lat_of_all, lon_of_each, lat_of_each;
  for (double tile = 0; tile < 2; ++tile) {
    for (double y = 0; y < 3; ++y) {
      for (double x = 0; x < 4; ++x) {
        lon_of_all.push_back(lon_of(tile, y, x));
        lat_of_all.push_back(lat_of(tile, y, x));
        if (y == 2 || x == 3) continue;
        lon.push_back(lon_of(tile, y + 0.5, x + 0.5));
        lat.push_back(lat_of(tile, y + 0.5, x + 0.5));
        for (const auto& [up, right] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
          lon_of_each.push_back(lon_of(tile, y + up, x + right));
          lat_of_each.push_back(lat_of(tile, y + up, x + right));
        }
      }
    }
  }
  const auto table_with = [&](const MeshWriter::Dimensions& corners, const Doubles& lons,
                              const Doubles& lats) {
    MeshWriter file;
    file.add("lon", cells, lon, {{"units", "degrees_east"}, {"bounds", "lon_bnds"}});
    file.add("lat", cells, lat, {{"units", "degrees_north"}, {"bounds", "lat_bnds"}});
    file.add("lon_bnds", corners, lons);
    file.add("lat_bnds", corners, lats);
    return cells_of_file(file);
  };
  const CellTable of_all = table_with({{"tile", 2}, {"yc", 3}, {"xc", 4}}, lon_of_all, lat_of_all);
  const CellTable corners_per_cell =
      table_with({{"tile", 2}, {"y", 2}, {"x", 3}, {"nv", 4}}, lon_of_each, lat_of_each);
  EXPECT_EQ(of_all.facts.shape, (std::vector<std::uint64_t>{2, 2, 3}));
  ASSERT_EQ(of_all.facts.centers.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(of_all.facts.centers[i], (LonLat{lon[i], lat[i]}));
  const CellSet one = CellSet::of(of_all);
  const CellSet other = CellSet::of(corners_per_cell);
  ASSERT_EQ(one.num_cells(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(one.areas()[i], other.areas()[i]);
    EXPECT_NEAR(one.areas()[i], 70 * std::pow(std::numbers::pi / 180, 2), 2e-3) << i;
  }
}

// Coordinates of every place that have no bounds are those of the axes, in either order, or the axes only pretend to be degrees.
TEST(overlay_mesh_blocks, axes_of_the_places_that_a_variable_names) {
  const Doubles lon = {10, 30, 50, 70};
  const Doubles lat = {-20, 0, 20};
  const auto table_with = [&](bool is_lon_last, double lon_off, double lat_off) {
    MeshWriter file;
    file.add("x", {{"x", 4}}, lon, {{"units", "degrees_east"}});
    file.add("y", {{"y", 3}}, lat, {{"units", "degrees_north"}});
    MeshWriter::Dimensions both = {{"y", 3}, {"x", 4}};
    if (!is_lon_last) std::swap(both[0], both[1]);
    Doubles lons, lats;
    for (std::size_t k = 0; k < 12; ++k) {
      lons.push_back(lon[is_lon_last ? k % 4 : k / 3] + (k == 7 ? lon_off : 0));
      lats.push_back(lat[is_lon_last ? k / 4 : k % 3] + (k == 7 ? lat_off : 0));
    }
    file.add("nav_lon", both, lons, {{"units", "degrees_east"}});
    file.add("nav_lat", both, lats, {{"units", "degrees_north"}});
    file.add("sst", both, Doubles(12, 1.0), {{"coordinates", "nav_lon nav_lat"}});
    return cells_of_file(file);
  };
  for (const bool is_lon_last : {true, false}) {
    EXPECT_EQ(table_with(is_lon_last, 0, 0).grid->lon_deg, (Doubles{0, 20, 40, 60, 80}));
    EXPECT_EQ(table_with(is_lon_last, 360, 0).grid->lat_deg, (Doubles{-30, -10, 10, 30}));
    EXPECT_THROW((void)table_with(is_lon_last, 0.01, 0), FileError);
    EXPECT_THROW((void)table_with(is_lon_last, 0, 0.01), FileError);
  }
}

// The seven cells of the cube, told apart by their numbers of corners and the areas: a numbering that mixes the two blocks.
TEST(overlay_mesh_blocks, exodus_cells_are_in_the_order_of_their_numbers) {
  const auto table = [](const std::vector<std::pair<std::string, Doubles>>& numbers) {
    MeshWriter file;
    for (const unsigned bit : {0U, 1U, 2U}) {
      file.add("coord" + std::string(1, "xyz"[bit]), {{"num_nodes", 8}}, coordinates_of_cube(bit));
    }
    add_blocks(file);
    for (const auto& [name, values] : numbers) {
      file.add_whole(name, {{"of_" + name, values.size()}}, values);
    }
    return cells_of_file(file);
  };
  const auto counts = [](const CellTable& cells) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < cells.num_cells(); ++i) {
      const std::uint64_t ring = cells.cells.cells[i];
      result.push_back(cells.cells.rings[ring + 1] - cells.cells.rings[ring]);
    }
    return result;
  };
  const std::vector<std::size_t> of_blocks = {4, 4, 4, 4, 4, 3, 3};
  const std::vector<std::size_t> by_number = {3, 4, 4, 3, 4, 4, 4};
  const Doubles numbers = {7, 2, 3, 5, 6, 1, 4};
  const CellTable plain = table({});
  EXPECT_EQ(counts(plain), of_blocks);
  const CellTable mapped = table({{"elem_num_map", numbers}});
  EXPECT_EQ(counts(mapped), by_number);
  EXPECT_TRUE(mapped.facts.remarks.empty());
  const std::vector<Point> in_blocks = CellSet::of(plain).centers();
  const std::vector<Point> ordered = CellSet::of(mapped).centers();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    EXPECT_EQ(ordered[static_cast<std::size_t>(numbers[k]) - 1], in_blocks[k]) << k;
  }
  const std::pair<std::string, Doubles> first = {"global_id1", {7, 2, 3, 5, 6}};
  const std::pair<std::string, Doubles> second = {"global_id2", {1, 4}};
  EXPECT_EQ(counts(table({first, second})), by_number);
  EXPECT_EQ(counts(table({first})), of_blocks);
  // Numbers of a part of a larger mesh say nothing of the order; one twice does not either.
  for (const Doubles& others : {Doubles{7, 2, 3, 5, 6, 1, 8}, Doubles{7, 2, 3, 5, 6, 1, 1},
                                Doubles{7, 2, 3, 5, 6, 0, 4}, Doubles{1, 2, 3}}) {
    const CellTable left = table({{"elem_num_map", others}});
    EXPECT_EQ(counts(left), of_blocks);
    EXPECT_EQ(left.facts.remarks, (std::vector<std::string>{
                                      "the numbers of \"elem_num_map\" are not 1 to 7, each once: "
                                      "cells are in the order of the blocks"}));
    EXPECT_EQ(counts(table({{"elem_num_map", others}, first, second})), by_number);
  }
}

// The mask of OASIS is 1 where a cell takes no part, and its corners are the first dimension.
TEST(overlay_mesh_blocks, oasis_with_a_mask) {
  MeshWriter file;
  const MeshWriter::Dimensions cells = {{"y_toce", 2}, {"x_toce", 3}};
  const MeshWriter::Dimensions corners = {{"crn_toce", 4}, {"y_toce", 2}, {"x_toce", 3}};
  Doubles lon, lat, lon_of_corners, lat_of_corners;
  for (const auto& [up, right] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 3; ++x) {
        lon_of_corners.push_back(10 * (x + right));
        lat_of_corners.push_back(5 * (y + up));
      }
    }
  }
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      lon.push_back(10 * x + 5);
      lat.push_back(5 * y + 2.5);
    }
  }
  file.add("toce.lon", cells, lon);
  file.add("toce.lat", cells, lat);
  file.add("toce.clo", corners, lon_of_corners);
  file.add("toce.cla", corners, lat_of_corners);
  file.add_whole("toce.msk", cells, {0, 1, 0, 0, 0, 1});
  const CellTable table = cells_of_file(file);
  EXPECT_EQ(table.facts.convention, "OASIS");
  EXPECT_EQ(table.facts.mask, (std::vector<std::int32_t>{1, 0, 1, 1, 1, 0}));
  EXPECT_EQ(table.facts.remarks,
            (std::vector<std::string>{"2 of 6 cells are masked by \"toce.msk\""}));
  EXPECT_EQ(table.facts.shape, (std::vector<std::uint64_t>{2, 3}));
  ASSERT_EQ(table.num_cells(), 6U);
  EXPECT_EQ(table.cells.cells, (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(table.facts.centers[4], (LonLat{15, 7.5}));
}

// Files of OASIS have lists of cells as grids of one row, or of one column. Their cells may end with
// corners that are missing; on a grid of rows such a cell is left out.
TEST(overlay_mesh_blocks, cells_of_oasis_in_one_row_may_have_fewer_corners) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [rows, columns] :
       {std::pair<std::uint64_t, std::uint64_t>{1, 4}, {4, 1}, {2, 2}}) {
    MeshWriter file;
    const MeshWriter::Dimensions corners = {{"crn", 4}, {"y", rows}, {"x", columns}};
    file.add("tri.lon", {{"y", rows}, {"x", columns}}, {3, 12, 23, 32});
    file.add("tri.lat", {{"y", rows}, {"x", columns}}, {2, 4, 2, 4});
    // The corners are the first dimension: the first ones of all cells, the second ones, ...
    file.add("tri.clo", corners, {0, 10, 20, 30, 5, 15, 25, 35, 5, 15, 25, 35, none, 10, none, 30});
    file.add("tri.cla", corners, {0, 0, 0, 0, 0, 0, 0, 0, 8, 8, 8, 8, none, 8, none, 8});
    const CellTable table = cells_of_file(file);
    ASSERT_EQ(table.num_cells(), 4U);
    if (rows == 2) {
      EXPECT_EQ(table.facts.mask, (std::vector<std::int32_t>{0, 1, 0, 1}));
      EXPECT_EQ(table.facts.remarks.size(), 1U);
    } else {
      EXPECT_TRUE(table.facts.mask.empty() && table.facts.remarks.empty());
      EXPECT_EQ(table.cells.rings, (std::vector<std::uint64_t>{0, 3, 7, 10, 14}));
    }
  }
}

TEST(overlay_mesh_blocks, oasis_corners_without_units_have_those_of_the_centers) {
  MeshWriter file;
  const MeshWriter::Dimensions corners = {{"crn_toce", 4}, {"y_toce", 1}, {"x_toce", 1}};
  const MeshWriter::Dimensions cells = {{"y_toce", 1}, {"x_toce", 1}};
  file.add("toce.lon", cells, {1.25}, {{"units", "radians"}});
  file.add("toce.lat", cells, {0.25});
  file.add("toce.clo", corners, {1, 1.5, 1.5, 1});
  file.add("toce.cla", corners, {0, 0, 0.5, 0.5});
  const CellTable table = cells_of_file(file);
  ASSERT_EQ(table.facts.centers.size(), 1U);
  EXPECT_NEAR(table.facts.centers[0].lat_deg, 0.25 * 180 / std::numbers::pi, 1e-13);
  double north = 0;
  for (const Point& corner : table.cells.points) north = std::max(north, corner.z);
  EXPECT_NEAR(north, std::sin(0.5), 1e-15);
}

}  // namespace
}  // namespace rondel::test
