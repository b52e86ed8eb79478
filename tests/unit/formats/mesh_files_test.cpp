// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One diagram in all conventions of meshes, grids with and without bounds, and what is wrong in files.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "rondel/weight_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/writer.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

constexpr std::size_t num_sites = 50;

struct MeshOfDiagram {
  std::vector<double> lon, lat;  // of the corners, degrees
  std::vector<LonLat> sites;
  std::vector<std::vector<std::size_t>> rings;
  std::size_t most = 0;
  std::vector<double> areas;
  std::vector<double> center_lon, center_lat;

  explicit MeshOfDiagram(std::uint64_t seed) {
    const Triangulation triangulation = triangulation_of("uniform", num_sites, seed);
    const Cells all = cells(triangulation);
    for (const LonLat& place : lonlats(all.points)) {
      lon.push_back(place.lon_deg);
      lat.push_back(place.lat_deg);
    }
    for (std::size_t i = 0; i < num_sites; ++i) {
      const Point& site = triangulation.sites()[i];
      sites.push_back(lonlats({&site, 1}).front());
      rings.emplace_back(all.rings[i].begin(), all.rings[i].end());
      most = std::max(most, rings.back().size());
    }
    const CellSet cell_set = CellSet::voronoi(triangulation);
    areas = {cell_set.areas().begin(), cell_set.areas().end()};
    for (const LonLat& center : lonlats(cell_set.centers())) {
      center_lon.push_back(center.lon_deg);
      center_lat.push_back(center.lat_deg);
    }
  }

  // Entry k of cell i, or `missing`.
  [[nodiscard]] std::vector<double> corners(
      const std::function<double(std::size_t)>& value,
      const std::function<double(const std::vector<std::size_t>&)>& missing) const {
    std::vector<double> result;
    for (const auto& ring : rings) {
      for (std::size_t k = 0; k < most; ++k) {
        result.push_back(k < ring.size() ? value(ring[k]) : missing(ring));
      }
    }
    return result;
  }
  [[nodiscard]] std::vector<double> counts() const {
    std::vector<double> result;
    for (const auto& ring : rings) result.push_back(static_cast<double>(ring.size()));
    return result;
  }
};

std::string path_of_test() {
  return temporary_path("mesh_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         ".nc";
}

CellTable table_of(const MeshWriter& writer) {
  writer.write(path_of_test());
  return read_cells(path_of_test());
}

std::vector<double> scaled_by(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> transposed_of(const std::vector<double>& values, std::size_t num_columns) {
  std::vector<double> result;
  for (std::size_t k = 0; k < num_columns; ++k) {
    for (std::size_t i = k; i < values.size(); i += num_columns) result.push_back(values[i]);
  }
  return result;
}

void expect_diagram(const CellTable& table, const MeshOfDiagram& mesh, const char* convention,
                    double tolerance = 1e-13) {
  EXPECT_EQ(table.facts.convention, convention);
  ASSERT_EQ(table.num_cells(), num_sites);
  const CellSet cell_set = CellSet::of(table);
  EXPECT_TRUE(cell_set.covers_sphere());
  for (std::size_t i = 0; i < num_sites; ++i) {
    EXPECT_NEAR(cell_set.areas()[i], mesh.areas[i], tolerance);
  }
}

double counted_from_1(std::size_t node) { return static_cast<double>(node + 1); }

TEST(overlay_mesh_files, ugrid) {
  const MeshOfDiagram mesh(1);
  for (const bool is_transposed : {false, true}) {
    for (const double first : {0.0, 1.0}) {
      MeshWriter file;
      const MeshWriter::Dimensions nodes = {{"node", mesh.lon.size()}};
      file.add_whole("mesh", {}, {0},
                     {{"cf_role", "mesh_topology"},
                      {"node_coordinates", "node_y node_x"},
                      {"face_dimension", "face"},
                      {"face_node_connectivity", "face_nodes"}},
                     {{"topology_dimension", 2}});
      file.add("node_x", nodes, mesh.lon, {{"units", "degrees_east"}});
      file.add("node_y", nodes, mesh.lat, {{"units", "degrees_north"}});
      const std::vector<double> entries =
          mesh.corners([&](std::size_t node) { return static_cast<double>(node) + first; },
                       [](const auto&) { return -999; });
      const MeshWriter::Numbers numbers = {{"start_index", first}, {"_FillValue", -999}};
      if (is_transposed) {
        file.add_whole("face_nodes", {{"corner", mesh.most}, {"face", num_sites}},
                       transposed_of(entries, mesh.most), {}, numbers);
      } else {
        file.add_whole("face_nodes", {{"face", num_sites}, {"corner", mesh.most}}, entries, {},
                       numbers);
      }
      expect_diagram(table_of(file), mesh, "UGRID");
    }
  }
}

TEST(overlay_mesh_files, scrip) {
  const MeshOfDiagram mesh(2);
  MeshWriter file;
  const MeshWriter::Dimensions corners = {{"grid_size", num_sites}, {"grid_corners", mesh.most}};
  const auto last = [](const std::vector<double>& values) {
    return [&](const std::vector<std::size_t>& ring) { return values[ring.back()]; };
  };
  // Radians, and every longitude once around for one of its cells.
  std::vector<double> lon =
      mesh.corners([&](std::size_t node) { return mesh.lon[node]; }, last(mesh.lon));
  for (std::size_t k = 0; k < lon.size(); k += 3) lon[k] += 360;
  const std::vector<double> lat =
      mesh.corners([&](std::size_t node) { return mesh.lat[node]; }, last(mesh.lat));
  constexpr double degree = std::numbers::pi / 180;
  file.add("grid_corner_lon", corners, scaled_by(lon, degree), {{"units", "radians"}});
  file.add("grid_corner_lat", corners, scaled_by(lat, degree), {{"units", "radians"}});
  std::vector<double> mask(num_sites, 1);
  mask[7] = 0;
  file.add_whole("grid_imask", {{"grid_size", num_sites}}, mask);
  file.add_whole("grid_dims", {{"grid_rank", 2}}, {10, 5});
  const CellTable table = table_of(file);
  expect_diagram(table, mesh, "SCRIP");
  EXPECT_EQ(table.facts.shape, (std::vector<std::uint64_t>{5, 10}));
  ASSERT_EQ(table.facts.mask.size(), num_sites);
  for (std::size_t i = 0; i < num_sites; ++i) EXPECT_EQ(table.facts.mask[i], i == 7 ? 0 : 1);
}

// Radians everywhere, of which one of the four variables says so.
TEST(overlay_mesh_files, scrip_coordinates_without_units_have_those_of_the_others) {
  const MeshOfDiagram mesh(6);
  constexpr double degree = std::numbers::pi / 180;
  const MeshWriter::Dimensions cells = {{"grid_size", num_sites}};
  const MeshWriter::Dimensions corners = {{"grid_size", num_sites}, {"grid_corners", mesh.most}};
  const auto corners_in_radians = [&](const std::vector<double>& values) {
    return scaled_by(mesh.corners([&](std::size_t node) { return values[node]; },
                                  [&](const auto& ring) { return values[ring.back()]; }),
                     degree);
  };
  for (const std::string with_units :
       {"grid_corner_lon", "grid_corner_lat", "grid_center_lon", "grid_center_lat"}) {
    MeshWriter file;
    const auto add = [&](const std::string& name, const MeshWriter::Dimensions& dimensions,
                         const std::vector<double>& values) {
      MeshWriter::Texts texts;
      if (name == with_units) texts = {{"units", "radians"}};
      file.add(name, dimensions, values, texts);
    };
    add("grid_corner_lon", corners, corners_in_radians(mesh.lon));
    add("grid_corner_lat", corners, corners_in_radians(mesh.lat));
    std::vector<double> lon;
    std::vector<double> lat;
    for (const LonLat& site : mesh.sites) {
      lon.push_back(site.lon_deg * degree);
      lat.push_back(site.lat_deg * degree);
    }
    add("grid_center_lon", cells, lon);
    add("grid_center_lat", cells, lat);
    const CellTable table = table_of(file);
    expect_diagram(table, mesh, "SCRIP");
    ASSERT_EQ(table.facts.centers.size(), num_sites) << with_units;
    EXPECT_NEAR(table.facts.centers[3].lon_deg, mesh.sites[3].lon_deg, 1e-12) << with_units;
    EXPECT_NEAR(table.facts.centers[3].lat_deg, mesh.sites[3].lat_deg, 1e-12) << with_units;
  }
}

TEST(overlay_mesh_files, lengths_that_do_not_multiply_to_the_cells) {
  const MeshOfDiagram mesh(2);
  const auto file_with = [&](const std::vector<double>& lengths) {
    MeshWriter file;
    const MeshWriter::Dimensions corners = {{"grid_size", num_sites}, {"grid_corners", mesh.most}};
    const auto add = [&](const char* name, const std::vector<double>& values) {
      file.add(
          name, corners,
          mesh.corners([&](std::size_t node) { return values[node]; },
                       [&](const std::vector<std::size_t>& ring) { return values[ring.back()]; }));
    };
    add("grid_corner_lon", mesh.lon);
    add("grid_corner_lat", mesh.lat);
    file.add_whole("grid_dims", {{"grid_rank", lengths.size()}}, lengths);
    return file;
  };
  EXPECT_TRUE(table_of(file_with({1})).facts.shape.empty());
  EXPECT_EQ(table_of(file_with({5, 2, 5})).facts.shape, (std::vector<std::uint64_t>{5, 2, 5}));
  for (const std::vector<double>& lengths : {std::vector<double>{10, 6}, {-10, -5}, {0, 50}}) {
    try {
      (void)table_of(file_with(lengths));
      ADD_FAILURE() << lengths[0];
    } catch (const FileError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("\"grid_dims\" is "), std::string::npos) << text;
      EXPECT_TRUE(text.ends_with(", which does not multiply to 50")) << text;
    }
  }
}

TEST(overlay_mesh_files, esmf) {
  const MeshOfDiagram mesh(3);
  MeshWriter file;
  std::vector<double> pairs;
  for (std::size_t i = 0; i < mesh.lon.size(); ++i) {
    pairs.insert(pairs.end(), {mesh.lon[i], mesh.lat[i]});
  }
  file.add("nodeCoords", {{"nodeCount", mesh.lon.size()}, {"coordDim", 2}}, pairs,
           {{"units", "degrees"}});
  file.add_whole("elementConn", {{"elementCount", num_sites}, {"maxNodePElement", mesh.most}},
                 mesh.corners(counted_from_1, [](const auto&) { return -1; }), {},
                 {{"_FillValue", -1}});
  file.add_whole("numElementConn", {{"elementCount", num_sites}}, mesh.counts());
  expect_diagram(table_of(file), mesh, "ESMF");
}

TEST(overlay_mesh_files, esmf_nodes_without_units_have_those_of_the_centers) {
  const MeshOfDiagram mesh(3);
  MeshWriter file;
  constexpr double degree = std::numbers::pi / 180;
  std::vector<double> pairs;
  for (std::size_t i = 0; i < mesh.lon.size(); ++i) {
    pairs.insert(pairs.end(), {mesh.lon[i] * degree, mesh.lat[i] * degree});
  }
  file.add("nodeCoords", {{"nodeCount", mesh.lon.size()}, {"coordDim", 2}}, pairs);
  std::vector<double> centers;
  for (const LonLat& site : mesh.sites) {
    centers.insert(centers.end(), {site.lon_deg * degree, site.lat_deg * degree});
  }
  file.add("centerCoords", {{"elementCount", num_sites}, {"coordDim", 2}}, centers,
           {{"units", "radians"}});
  file.add_whole("elementConn", {{"elementCount", num_sites}, {"maxNodePElement", mesh.most}},
                 mesh.corners(counted_from_1, [](const auto&) { return -1; }), {},
                 {{"_FillValue", -1}});
  file.add_whole("numElementConn", {{"elementCount", num_sites}}, mesh.counts());
  expect_diagram(table_of(file), mesh, "ESMF");
}

// Two triangles as one element, the second clockwise.
TEST(overlay_mesh_files, esmf_elements_in_parts) {
  MeshWriter file;
  file.add("nodeCoords", {{"nodeCount", 6}, {"coordDim", 2}},
           {0, 0, 10, 0, 0, 10, 50, 0, 50, 10, 60, 0});
  file.add_whole("elementConn", {{"elementCount", 1}, {"maxNodePElement", 7}},
                 {1, 2, 3, -8, 4, 5, 6}, {}, {{"polybreak_value", -8}});
  file.add_whole("numElementConn", {{"elementCount", 1}}, {7});
  const CellTable table = table_of(file);
  EXPECT_EQ(table.cells.cells, (std::vector<std::uint64_t>{0, 2}));
  EXPECT_EQ(table.cells.corners, (std::vector<Index>{0, 1, 2, 5, 4, 3}));
}

TEST(overlay_mesh_files, mpas) {
  const MeshOfDiagram mesh(4);
  MeshWriter file;
  constexpr double degree = std::numbers::pi / 180;
  const MeshWriter::Dimensions vertices = {{"nVertices", mesh.lon.size()}};
  file.add_attribute("on_a_sphere", "YES");
  file.add("lonVertex", vertices, scaled_by(mesh.lon, degree), {{"units", "rad"}});
  file.add("latVertex", vertices, scaled_by(mesh.lat, degree), {{"units", "rad"}});
  file.add_whole("verticesOnCell", {{"nCells", num_sites}, {"maxEdges", mesh.most}},
                 mesh.corners(counted_from_1, [](const auto&) { return 0; }));
  file.add_whole("nEdgesOnCell", {{"nCells", num_sites}}, mesh.counts());
  expect_diagram(table_of(file), mesh, "MPAS");
}

// In single precision.
TEST(overlay_mesh_files, icon) {
  const MeshOfDiagram mesh(5);
  MeshWriter file;
  constexpr double degree = std::numbers::pi / 180;
  const MeshWriter::Dimensions vertices = {{"vertex", mesh.lon.size()}};
  const auto single = io::NetcdfType::float32;
  file.add("vlon", vertices, scaled_by(mesh.lon, degree), {{"units", "radian"}}, {}, single);
  file.add("vlat", vertices, scaled_by(mesh.lat, degree), {{"units", "radian"}}, {}, single);
  file.add_whole(
      "vertex_of_cell", {{"nv", mesh.most}, {"cell", num_sites}},
      transposed_of(mesh.corners(counted_from_1, [](const auto&) { return 0; }), mesh.most));
  expect_diagram(table_of(file), mesh, "ICON", 2e-6);
}

TEST(overlay_mesh_files, cf_cells_with_bounds) {
  const MeshOfDiagram mesh(6);
  MeshWriter file;
  const MeshWriter::Dimensions cell = {{"cell", num_sites}};
  const MeshWriter::Dimensions corners = {{"cell", num_sites}, {"nv", mesh.most}};
  file.add("clon", cell, mesh.center_lon, {{"units", "degrees_east"}, {"bounds", "clon_bnds"}});
  file.add("clat", cell, mesh.center_lat, {{"units", "degrees_north"}, {"bounds", "clat_bnds"}});
  for (const auto& [name, values] : {std::pair{"clon_bnds", &mesh.lon}, {"clat_bnds", &mesh.lat}}) {
    file.add(name, corners,
             mesh.corners([&v = *values](std::size_t node) { return v[node]; },
                          [&v = *values](const auto& ring) { return v[ring.back()]; }));
  }
  expect_diagram(table_of(file), mesh, "CF");
}

CellTable lonlat_table(const std::vector<double>& lon, const std::vector<double>& lat,
                       const std::vector<double>& lon_bounds = {},
                       const std::vector<double>& lat_bounds = {}) {
  MeshWriter file;
  const MeshWriter::Texts east = {{"units", "degrees_east"}};
  const MeshWriter::Texts north = {{"units", "degrees_north"}};
  const auto with_bounds = [](MeshWriter::Texts texts, const char* name) {
    texts.emplace_back("bounds", name);
    return texts;
  };
  file.add("lon", {{"lon", lon.size()}}, lon,
           lon_bounds.empty() ? east : with_bounds(east, "lon_bnds"));
  file.add("lat", {{"lat", lat.size()}}, lat,
           lat_bounds.empty() ? north : with_bounds(north, "lat_bnds"));
  if (!lon_bounds.empty()) file.add("lon_bnds", {{"lon", lon.size()}, {"two", 2}}, lon_bounds);
  if (!lat_bounds.empty()) file.add("lat_bnds", {{"lat", lat.size()}, {"two", 2}}, lat_bounds);
  return table_of(file);
}

using Doubles = std::vector<double>;

TEST(overlay_mesh_files, cf_lines_between_coordinates) {
  // From north to south, as a Gaussian grid; across the antimeridian.
  const CellTable table = lonlat_table({0, 90, 180, -90}, {60, 20, -20, -60});
  ASSERT_TRUE(table.grid.has_value());
  EXPECT_EQ(table.grid->lon_deg, (Doubles{-45, 45, 135, 225, 315}));
  EXPECT_EQ(table.grid->lat_deg, (Doubles{90, 40, 0, -40, -90}));
  EXPECT_EQ(table.facts.shape, (std::vector<std::uint64_t>{4, 4}));
  EXPECT_EQ(table.facts.given_centers()[5], (LonLat{90, 20}));
  EXPECT_TRUE(CellSet::of(table).covers_sphere());
  EXPECT_FALSE(CellSet::of(table, GridSides::great_circles).areas().empty());
  // A region, and rows with the poles as coordinates.
  EXPECT_EQ(lonlat_table({5, 6, 7}, {50, 52}).grid->lat_deg, (Doubles{49, 51, 53}));
  EXPECT_EQ(lonlat_table({5, 6, 7}, {50, 52}).grid->lon_deg, (Doubles{4.5, 5.5, 6.5, 7.5}));
  EXPECT_EQ(lonlat_table({0, 180}, {-90, 0, 90}).grid->lat_deg, (Doubles{-90, -45, 45, 90}));
}

TEST(overlay_mesh_files, cf_lines_of_bounds) {
  // The second bounds are turned around the globe; latitudes go south, their bounds north.
  const CellTable table =
      lonlat_table({10, 30, 60}, {5, -5}, {0, 20, 380, 400, 40, 80}, {0, 10, -9, 0});
  EXPECT_EQ(table.grid->lon_deg, (Doubles{0, 20, 40, 80}));
  EXPECT_EQ(table.grid->lat_deg, (Doubles{10, 0, -9}));
  // Around the globe but for rounding to single precision.
  EXPECT_EQ(lonlat_table({60, 180, 300}, {0}, {0, 120, 120, 240, 240, 359.99999}, {-90, 90})
                .grid->lon_deg.back(),
            360);
}

TEST(overlay_mesh_files, cf_bounds_with_the_two_ends_first) {
  MeshWriter file;
  const MeshWriter::Dimensions ends_first = {{"two", 2}, {"lon", 3}};
  file.add("lon", {{"lon", 3}}, {10, 30, 60}, {{"units", "degrees_east"}, {"bounds", "lon_bnds"}});
  file.add("lat", {{"lat", 2}}, {5, -5}, {{"units", "degrees_north"}, {"bounds", "lat_bnds"}});
  file.add("lon_bnds", ends_first, {0, 20, 40, 20, 40, 80});
  file.add("lat_bnds", {{"two", 2}, {"lat", 2}}, {10, 0, 0, -9});
  const CellTable table = table_of(file);
  EXPECT_EQ(table.grid->lon_deg, (Doubles{0, 20, 40, 80}));
  EXPECT_EQ(table.grid->lat_deg, (Doubles{10, 0, -9}));
}

std::string refusal_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const FileError& error) {
    const std::string what = error.what();
    return what.substr(what.find(".nc: ") + 5);
  }
  return "";
}

TEST(overlay_mesh_files, cells_of_corners_find_equal_ones) {
  const MeshOfDiagram mesh(4);
  std::vector<LonLat> corners;
  for (const auto& ring : mesh.rings) {
    for (std::size_t k = 0; k < mesh.most; ++k) {
      const std::size_t node = ring[std::min(k, ring.size() - 1)];
      // A turn, and less than rounding of files, makes no other corner.
      const double turn = k % 2 == 0 ? 360 : 0;
      corners.push_back({mesh.lon[node] + turn, mesh.lat[node]});
    }
  }
  const CellSet cells = CellSet::polygons(cells_of_corners(corners, mesh.most));
  EXPECT_TRUE(cells.covers_sphere());
  ASSERT_EQ(cells.num_cells(), num_sites);
  for (std::size_t i = 0; i < num_sites; ++i) {
    EXPECT_NEAR(cells.areas()[i], mesh.areas[i], 1e-12) << i;
  }
  EXPECT_THROW(cells_of_corners(corners, 0), InvalidInput);
  EXPECT_THROW(cells_of_corners(corners, corners.size() - 1), InvalidInput);
  corners[2 * mesh.most + 1].lat_deg = 91;
  EXPECT_EQ(thrown_index([&] { return cells_of_corners(corners, mesh.most); }), 2U) << "no place";
}

TEST(overlay_mesh_files, given_rings_make_the_same_cells) {
  // Rings that begin anywhere: of a diagram, and of a hole in a box.
  const MeshOfDiagram mesh(11);
  CellRings rings;
  for (std::size_t k = 0; k < mesh.lon.size(); ++k) {
    rings.points.push_back(unit_vector({mesh.lon[k], mesh.lat[k]}));
  }
  for (std::size_t i = 0; i < num_sites; ++i) {
    for (std::size_t k = 0; k < mesh.rings[i].size(); ++k) {
      const std::size_t corner = mesh.rings[i][(k + i) % mesh.rings[i].size()];
      rings.corners.push_back(static_cast<Index>(corner));
    }
    rings.rings.push_back(rings.corners.size());
    rings.cells.push_back(rings.rings.size() - 1);
  }
  const CellSet cells = CellSet::polygons(rings);
  const CellRings given = cells.given_rings();
  ASSERT_EQ(given.corners.size(), rings.corners.size());
  for (std::size_t k = 0; k < rings.corners.size(); ++k) {
    EXPECT_EQ(given.points[given.corners[k]].x, rings.points[rings.corners[k]].x) << k;
  }
  const CellSet again = CellSet::polygons(given);
  const std::span<const double> areas = cells.areas();
  EXPECT_TRUE(std::ranges::equal(again.areas(), areas));
  // The areas depend on where the rings begin.
  const CellSet turned = CellSet::polygons(cells.rings());
  EXPECT_FALSE(std::ranges::equal(turned.areas(), areas));
  EXPECT_THROW((void)CellSet::lonlat_grid({{0, 90}, {0, 45}}).given_rings(), InvalidInput);
}

// A curvilinear grid of n x n cells, which is turned against the axes: its centers, and the nodes
// around them, (n + 1) x (n + 1).
struct TurnedGrid {
  std::vector<double> lon, lat, node_lon, node_lat;

  explicit TurnedGrid(std::size_t n) {
    for (std::size_t j = 0; j <= n; ++j) {
      for (std::size_t i = 0; i <= n; ++i) {
        const auto add = [](std::vector<double>& lons, std::vector<double>& lats, double x,
                            double y) {
          lons.push_back(170 + 3 * x + y);
          lats.push_back(-20 + 2 * y - x / 2);
        };
        const auto x = static_cast<double>(i);
        const auto y = static_cast<double>(j);
        add(node_lon, node_lat, x, y);
        if (i < n && j < n) add(lon, lat, x + 0.5, y + 0.5);
      }
    }
  }

  // Returns a file in which the nodes have these dimensions.
  [[nodiscard]] MeshWriter file(std::size_t n, const MeshWriter::Dimensions& lon_dimensions,
                                const MeshWriter::Dimensions& lat_dimensions) const {
    MeshWriter file;
    const MeshWriter::Dimensions cells = {{"y", n}, {"x", n}};
    file.add("lon", cells, lon, {{"units", "degrees_east"}});
    file.add("lat", cells, lat, {{"units", "degrees_north"}});
    file.add("t", cells, lat, {{"coordinates", "lon lat"}});
    file.add("lon_b", lon_dimensions, node_lon);
    file.add("lat_b", lat_dimensions, node_lat);
    return file;
  }
};

TEST(overlay_mesh_files, nodes_of_a_square_grid_in_any_order) {
  constexpr std::size_t n = 7;
  const MeshWriter::Dimensions by_rows = {{"y_b", n + 1}, {"x_b", n + 1}};
  const MeshWriter::Dimensions by_columns = {{"x_b", n + 1}, {"y_b", n + 1}};
  const TurnedGrid grid(n);
  const CellTable straight = table_of(grid.file(n, by_rows, by_rows));
  const std::vector<Point> centers = CellSet::of(straight).centers();
  for (std::size_t i = 0; i < n * n; ++i) {
    const LonLat middle = lonlats(std::vector{centers[i]}).front();
    EXPECT_NEAR(std::remainder(middle.lon_deg - grid.lon[i], 360), 0, 1e-2);
    EXPECT_NEAR(middle.lat_deg, grid.lat[i], 1e-2);
  }
  TurnedGrid turned = grid;
  turned.node_lon = transposed_of(grid.node_lon, n + 1);
  const TurnedGrid lon_turned = turned;
  turned.node_lat = transposed_of(grid.node_lat, n + 1);
  for (const CellTable& table : {table_of(turned.file(n, by_columns, by_columns)),
                                 table_of(lon_turned.file(n, by_columns, by_rows))}) {
    EXPECT_TRUE(table.facts.remarks.empty());
    const std::vector<Point> found = CellSet::of(table).centers();
    for (std::size_t i = 0; i < n * n; ++i) EXPECT_NEAR(dot(found[i], centers[i]), 1, 1e-12);
  }
}

TEST(overlay_mesh_files, nodes_with_rows_and_columns_of_different_lengths) {
  const std::vector<LonLat> nodes = {{0, 0}, {0, 1}, {0, 2}, {5, 0}, {5, 1}, {5, 2}};
  const std::vector<LonLat> centers = {{2, 0.5}, {2, 1.5}};
  // The nodes of two rows and one column, which go northward first.
  const std::vector<LonLat> corners = corners_of_grid(nodes, {2, 3}, centers, {2, 1});
  const std::vector<LonLat> expected = {{0, 0}, {5, 0}, {5, 1}, {0, 1},
                                        {0, 1}, {5, 1}, {5, 2}, {0, 2}};
  ASSERT_EQ(corners.size(), expected.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    EXPECT_EQ(corners[k].lon_deg, expected[k].lon_deg) << k;
    EXPECT_EQ(corners[k].lat_deg, expected[k].lat_deg) << k;
  }
  EXPECT_THROW((void)corners_of_grid(nodes, {2, 3}, centers, {1, 3}), InvalidInput);
  EXPECT_THROW((void)corners_of_grid(nodes, {2, 3}, centers, {1, 1}), InvalidInput);
  EXPECT_THROW((void)corners_of_grid(nodes, {0, 0}, {}, {1, 1}), InvalidInput);
}

TEST(overlay_mesh_files, centers_outside_of_their_cells) {
  constexpr std::size_t n = 7;
  const MeshWriter::Dimensions nodes = {{"y_b", n + 1}, {"x_b", n + 1}};
  const TurnedGrid grid(n);
  TurnedGrid other = grid;
  std::ranges::reverse(other.node_lat);
  EXPECT_NE(
      refusal_of([&] { (void)table_of(other.file(n, nodes, nodes)); })
          .find("cells with the corners \"lon_b\" and \"lat_b\" do not contain their centers, "
                "the first one cell 0 with the center 172 -19.25"),
      std::string::npos);
  other = grid;
  for (double& lon : other.node_lon) lon += 100;
  EXPECT_EQ(refusal_of([&] { (void)table_of(other.file(n, nodes, nodes)); }).substr(0, 8),
            "49 of 49");
  // Land has no coordinates here but zeros.
  other = grid;
  other.lon[3] = other.lat[3] = 0;
  const CellTable told = table_of(other.file(n, nodes, nodes));
  ASSERT_EQ(told.facts.remarks.size(), 1U);
  EXPECT_EQ(told.facts.remarks[0],
            "1 of 49 cells with the corners \"lon_b\" and \"lat_b\" do not contain their centers, "
            "the first one cell 3 with the center 0 0");
  for (std::size_t i = 0; i < n * n; ++i) {
    if (i % n >= 2) other.lon[i] = other.lat[i] = 0;
  }
  const CellTable zeros = table_of(other.file(n, nodes, nodes));
  ASSERT_EQ(zeros.facts.remarks.size(), 1U);
  EXPECT_TRUE(zeros.facts.remarks[0].starts_with("35 of 49 cells")) << zeros.facts.remarks[0];
}

TEST(overlay_mesh_files, sound_centers_are_inside) {
  // A cap around a pole, a cell with a corner at the pole, a triangle with the center at a corner, a
  // cell across the antimeridian, an empty cell, and one as large as a hemisphere.
  const std::vector<LonLat> corners = {
      {0, 80},  {90, 80}, {180, 80}, {-90, 80}, {0, 89},  {90, 89}, {90, 90},  {0, 90},
      {10, 10}, {12, 10}, {10, 12},  {10, 12},  {179, 0}, {181, 0}, {-179, 1}, {-181, 1},
      {0, 0},   {0, 0},   {0, 0},    {0, 0},    {0, 0},   {90, 0},  {180, 0},  {-90, 0}};
  const CellRings cells = cells_of_corners(corners, 4);
  std::vector<LonLat> centers = {{77, 90}, {45, 89.5}, {10, 10}, {180, 0.5}, {50, 50}, {0, 89}};
  EXPECT_EQ(centers_outside(cells, centers).number, 0U);
  EXPECT_EQ(centers_outside(cells, centers).of, 5U);
  centers = {{77, 79}, {225, 88}, {8, 10}, {178, 0.5}, {50, 50}, {0, -89}};
  const CentersOutside outside = centers_outside(cells, centers);
  EXPECT_EQ(outside.number, 4U);
  EXPECT_EQ(outside.first, 0U);
  EXPECT_EQ(centers_outside(cells, centers, std::vector{0, 1, 1, 0, 1, 1}).number, 2U);
  EXPECT_EQ(centers_outside(cells, centers, std::vector{0, 1, 1, 0, 1, 1}).first, 1U);
  centers[1].lat_deg = std::nan("");
  EXPECT_EQ(centers_outside(cells, centers).of, 4U);
  centers.pop_back();
  EXPECT_THROW((void)centers_outside(cells, centers), InvalidInput);
}

TEST(overlay_mesh_files, a_grid_around_its_centers) {
  using Numbers = std::vector<double>;
  const LonLatGrid grid = grid_around(Numbers{350, 355, 0, 10}, Numbers{80, 85, 89});
  EXPECT_EQ(grid.lon_deg, (Numbers{347.5, 352.5, 357.5, 365, 375}));
  EXPECT_EQ(grid.lat_deg, (Numbers{77.5, 82.5, 87, 90}));
  const auto index_of_error = [](const Numbers& lon, const Numbers& lat) {
    return thrown_index([&] { return grid_around(lon, lat); });
  };
  EXPECT_EQ(index_of_error({1, 2}, {1}), 0U);
  EXPECT_EQ(index_of_error({1, 2, NAN}, {1, 2}), 2U);
  EXPECT_EQ(index_of_error({1, 2}, {1, INFINITY}), 1U);
}

TEST(overlay_mesh_files, names_what_is_wrong) {
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1}, {2, 3});
            }),
            "variable \"lon\": one longitude without bounds, 1, has no width");
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1, 2}, {2, 3}, {0, 1, 2, 3});
            }),
            "variable \"lon_bnds\": bounds leave a gap before cell 1");
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1, 2}, {-10, 5, 0, 10});
            }),
            "variable \"lat\": latitude 2, 0, is not north of latitude 1, 5, but an axis of cells "
            "must increase or decrease throughout");
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1, 1}, {2, 3}, {0, 1, 1, 2});
            }),
            "variable \"lon\": longitude 1, 1, repeats longitude 0, 1, but an axis of cells must "
            "increase or decrease throughout");
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1, NAN}, {2, 3});
            }),
            "variable \"lon\": longitude 1 is not finite");
  EXPECT_EQ(refusal_of([] {
              (void)lonlat_table({1, 2}, {80, 99});
            }),
            "variable \"lat\": latitude 99 is beyond a pole");
  const auto ugrid = [](const Doubles& lat, const Doubles& nodes) {
    MeshWriter file;
    file.add_whole("mesh", {}, {0},
                   {{"cf_role", "mesh_topology"},
                    {"node_coordinates", "x y"},
                    {"face_node_connectivity", "faces"}});
    file.add("x", {{"node", 3}}, {0, 1, 0});
    file.add("y", {{"node", 3}}, lat);
    file.add_whole("faces", {{"face", nodes.size() / 3}, {"corner", 3}}, nodes);
    return CellSet::of(table_of(file)).num_cells();
  };
  EXPECT_EQ(ugrid({0, 0, 1}, {0, 1, 2}), 1U);
  EXPECT_EQ(refusal_of([&] {
              (void)ugrid({0, 0, 1}, {0, 1, 2, 0, 1, 3});
            }),
            "cell 1 has a corner 3 of 3 nodes in \"faces\"");
  EXPECT_EQ(refusal_of([&] {
              (void)ugrid({0, 95, 1}, {0, 1, 2});
            }),
            "value 1 of \"x\" and \"y\", 1 and 95 degrees, is no place");
  MeshWriter plane;
  plane.add_attribute("on_a_sphere", "NO");
  plane.add_whole("verticesOnCell", {{"nCells", 1}, {"maxEdges", 3}}, {1, 2, 3});
  EXPECT_EQ(refusal_of([&] { (void)table_of(plane); }),
            "the mesh is in the plane: on_a_sphere is NO");
  MeshWriter none;
  none.add("height", {{"x", 1}}, {0});
  EXPECT_EQ(refusal_of([&] { (void)table_of(none); }).substr(0, 19), "it has no cells: it");
  EXPECT_THROW((void)read_cells(FileName{"grid.csv"}), FileError);
}

}  // namespace
}  // namespace rondel::test
