// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Spacings of files are compared with the function from which the files were written.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "meshing/scvt_levels.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_size_files.h"
#include "support/temporary_files.h"
#include "support/thrown.h"
#include "unit/meshing/support.h"
#include "unit/meshing/writer.h"

namespace rondel::mesh {
namespace {

using test::MeshWriter;

// Kilometers on a sphere of 1000 km.
double wanted(const Point& p) { return 100 + 40 * p.z + 20 * p.x; }
double wanted(double lon, double lat) { return wanted(unit_vector(LonLat{lon, lat})); }

const MeshWriter::Texts eastward = {{"units", "degrees_east"}};
const MeshWriter::Texts northward = {{"units", "degrees_north"}};

std::string path_of(const std::string& name) { return temporary_path(name); }

void expect_wanted(const SizeFunction& size, double relative) {
  for (const Point& p : sampled_sites(2000, nullptr, 3)) {
    EXPECT_NEAR(size.spacing(p) * 1000, wanted(p), relative * wanted(p));
  }
}

// The spacing of a tessellation of density h^-4, the largest being 1.
void expect_proportions(const SizeFunction& size, double relative) {
  const double scale = size.spacing({1, 0, 0}) / wanted(Point{1, 0, 0});
  for (const Point& p : sampled_sites(2000, nullptr, 3)) {
    EXPECT_NEAR(size.spacing(p), scale * wanted(p), relative * scale * wanted(p));
  }
}

struct Axes {
  std::vector<double> lon;
  std::vector<double> lat;
};
Axes axes_of(double step) {
  Axes axes;
  for (double x = 0; x < 360; x += step) axes.lon.push_back(x);
  for (double y = 90; y >= -90; y -= step) axes.lat.push_back(y);
  return axes;
}

TEST(mesh_spacing_files, grid_of_netcdf) {
  const Axes axes = axes_of(5);
  std::vector<double> spacings;
  std::vector<double> densities;
  for (const double y : axes.lat) {
    for (const double x : axes.lon) {
      spacings.push_back(wanted(x, y));
      densities.push_back(1e9 * std::pow(wanted(x, y), -4));
    }
  }
  const std::uint64_t rows = axes.lat.size();
  const std::uint64_t columns = axes.lon.size();
  const std::string path = path_of("grid.nc");
  MeshWriter file;
  file.add("lat", {{"lat", rows}}, axes.lat, northward);
  file.add("lon", {{"lon", columns}}, axes.lon, eastward);
  file.add("h", {{"lat", rows}, {"lon", columns}}, spacings, {{"units", "km"}});
  file.write(path);
  expect_wanted(read_spacings({path, {}}, "h", 1e-3, 256), 2e-3);
  expect_wanted(read_spacings({path, {}}, "", 1e-3, 256), 2e-3);
  file.add("rho", {{"time", 1}, {"lat", rows}, {"lon", columns}}, densities);
  file.write(path);
  expect_proportions(read_density({path, {}}, "rho", 256), 2e-3);
  EXPECT_THROW((void)read_spacings({path, {}}, "", 1e-3, 256), FileError);
  EXPECT_THROW((void)read_spacings({path, {}}, "lat", 1e-3, 256), FileError);
  EXPECT_THROW((void)read_spacings({path, {}}, "none", 1e-3, 256), FileError);
}

TEST(mesh_spacing_files, points_of_netcdf_and_tables) {
  const std::vector<Point> places = sampled_sites(4000, nullptr, 1);
  std::vector<double> lon;
  std::vector<double> lat;
  std::vector<double> spacings;
  std::ofstream table(path_of("spacings.csv"));
  table.precision(17);
  table << "lon,lat,h\n";
  for (const Point& p : places) {
    lon.push_back(std::atan2(p.y, p.x) * 180 / std::numbers::pi);
    lat.push_back(std::asin(p.z) * 180 / std::numbers::pi);
    spacings.push_back(wanted(p));
    table << lon.back() << ',' << lat.back() << ',' << spacings.back() << '\n';
  }
  table.close();
  const std::uint64_t n = places.size();
  MeshWriter file;
  file.add("x", {{"place", n}}, lon, eastward);
  file.add("y", {{"place", n}}, lat, northward);
  file.add("h", {{"place", n}}, spacings, {{"coordinates", "x y"}});
  file.write(path_of("points.nc"));
  expect_wanted(read_spacings({path_of("points.nc"), {}}, "h", 1e-3, 256), 2e-3);
  expect_wanted(read_spacings({path_of("spacings.csv"), {}}, "h", 1e-3, 256), 2e-3);
}

// A record that nothing has been written to, and a variable along a dimension of length 0.
TEST(mesh_spacing_files, variables_without_values_are_no_fields) {
  std::vector<double> lon;
  std::vector<double> lat;
  std::vector<double> spacings;
  for (const Point& p : sampled_sites(4000, nullptr, 2)) {
    lon.push_back(std::atan2(p.y, p.x) * 180 / std::numbers::pi);
    lat.push_back(std::asin(p.z) * 180 / std::numbers::pi);
    spacings.push_back(wanted(p));
  }
  MeshWriter file;
  file.add("lon", {{"place", lon.size()}}, lon, eastward);
  file.add("lat", {{"place", lon.size()}}, lat, northward);
  file.add("empty", {{"time", 0}}, {});
  file.add("record", {{"time", 0}, {"place", lon.size()}}, {});
  file.add("h", {{"place", lon.size()}}, spacings);
  file.write(path_of("empty.nc"));
  expect_wanted(read_spacings({path_of("empty.nc"), {}}, "", 1e-3, 64), 1e-2);
}

// Values on meshes of the formats that the library writes are at the places of their cells.
TEST(mesh_spacing_files, cells_of_meshes) {
  const std::vector<Point> sites = sampled_sites(2000, nullptr, 5);
  std::vector<double> density;
  for (const Point& p : sites) density.push_back(std::pow(60 / wanted(p), 4));
  const VoronoiMesh made = make_mesh(delaunay(Sites::view(sites)), {.density = density});
  const std::string path = path_of("spacing_mesh.nc");
  write(path, made, {.format = MeshFormat::mpas});
  expect_proportions(read_density({path, {}}, "meshDensity", 256), 5e-3);

  // A face has a spacing; the file says where faces are in the topology alone.
  MeshWriter file;
  const std::uint64_t n = sites.size();
  std::vector<double> lon;
  std::vector<double> lat;
  std::vector<double> spacings;
  for (const Point& p : sites) {
    lon.push_back(std::atan2(p.y, p.x) * 180 / std::numbers::pi);
    lat.push_back(std::asin(p.z) * 180 / std::numbers::pi);
    spacings.push_back(wanted(p));
  }
  std::vector<double> node_lon;
  std::vector<double> node_lat;
  for (const Point& p : made.vertex_points) {
    node_lon.push_back(std::atan2(p.y, p.x) * 180 / std::numbers::pi);
    node_lat.push_back(std::asin(p.z) * 180 / std::numbers::pi);
  }
  const std::uint64_t room = made.max_edges();
  std::vector<double> nodes(n * room, -1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint64_t k = made.edges_on_cell.offsets[i]; k < made.edges_on_cell.offsets[i + 1];
         ++k) {
      nodes[i * room + k - made.edges_on_cell.offsets[i]] = made.vertices_on_cell[k];
    }
  }
  file.add_whole("mesh", {}, {0},
                 {{"cf_role", "mesh_topology"},
                  {"node_coordinates", "node_x node_y"},
                  {"face_coordinates", "face_x face_y"},
                  {"face_node_connectivity", "faces"}},
                 {{"topology_dimension", 2}});
  file.add("node_x", {{"node", node_lon.size()}}, node_lon, eastward);
  file.add("node_y", {{"node", node_lon.size()}}, node_lat, northward);
  file.add("face_x", {{"face", n}}, lon, eastward);
  file.add("face_y", {{"face", n}}, lat, northward);
  file.add_whole("faces", {{"face", n}, {"corner", room}}, nodes, {},
                 {{"start_index", 0}, {"_FillValue", -1}});
  file.add("h", {{"face", n}}, spacings, {{"mesh", "mesh"}, {"location", "face"}});
  file.write(path);
  expect_wanted(read_spacings({path, {}}, "h", 1e-3, 256), 4e-3);
}

// Faces of UGRID that have no coordinates are where their corners are.
TEST(mesh_spacing_files, faces_without_centers) {
  MeshWriter file;
  const std::vector<Point> sites = sampled_sites(3000, nullptr, 5);
  const Triangulation triangulation = delaunay(Sites::view(sites));
  std::vector<double> lon;
  std::vector<double> lat;
  for (const Point& site : sites) {
    lon.push_back(std::atan2(site.y, site.x) * 180 / std::numbers::pi);
    lat.push_back(std::asin(site.z) * 180 / std::numbers::pi);
  }
  std::vector<double> corners;
  std::vector<double> spacings;
  for (const Triple& face : triangulation.faces()) {
    Point sum{};
    for (const Index corner : face) {
      const Point& p = sites[corner];
      sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
      corners.push_back(corner);
    }
    const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    spacings.push_back(wanted({sum.x / length, sum.y / length, sum.z / length}));
  }
  const std::uint64_t num_faces = triangulation.num_faces();
  file.add_whole("mesh", {}, {0},
                 {{"cf_role", "mesh_topology"},
                  {"node_coordinates", "node_x node_y"},
                  {"face_dimension", "face"},
                  {"face_node_connectivity", "face_nodes"}},
                 {{"topology_dimension", 2}});
  file.add("node_x", {{"node", lon.size()}}, lon, eastward);
  file.add("node_y", {{"node", lat.size()}}, lat, northward);
  file.add_whole("face_nodes", {{"face", num_faces}, {"three", 3}}, corners, {},
                 {{"start_index", 0}});
  file.add("h", {{"face", num_faces}}, spacings,
           {{"units", "km"}, {"mesh", "mesh"}, {"location", "face"}});
  file.add("empty", {{"none", 0}}, {});
  const std::string path = path_of("faces.nc");
  file.write(path);
  expect_wanted(read_spacings({path, {}}, "h", 1e-3, 64), 3e-2);
}

TEST(mesh_spacing_files, values_that_are_no_spacings_are_named) {
  const std::string path = path_of("bad_spacings.nc");
  const auto message = [&](std::vector<double> values) {
    MeshWriter file;
    file.add("lon", {{"place", 4}}, {0, 90, 180, 270}, eastward);
    file.add("lat", {{"place", 4}}, {-30, 30, -30, 30}, northward);
    file.add("h", {{"place", 4}}, std::move(values));
    file.write(path);
    return test::thrown_message<FileError>([&] {
      return read_spacings({path, {}}, "h", 1e-3, 16);
    });
  };
  EXPECT_EQ(message({100, 100, 100, 200}), "");
  EXPECT_NE(message({100, 100, -5, 200}).find("spacing -5 at place 2"), std::string::npos);
  EXPECT_NE(message({100, 9000, 5, 200}).find("at place 1"), std::string::npos);
}

TEST(mesh_spacing_files, tells_of_places_without_a_value_and_of_contradictions) {
  const std::string path = temporary_path("contradictions.csv");
  const auto remarks_on = [&](const std::string& rows, bool is_density) {
    std::ofstream(path)
        << "lon,lat,h\n0,0,100\n90,0,100\n180,0,100\n-90,0,100\n0,90,100\n0,-90,100\n"
        << rows;
    std::vector<std::string> remarks;
    if (is_density) {
      (void)read_density({path, {}}, "h", 16, {}, &remarks);
    } else {
      (void)read_spacings({path, {}}, "h", 1e-3, 16, {}, &remarks);
    }
    return remarks;
  };
  using Remarks = std::vector<std::string>;
  for (const bool is_density : {false, true}) {
    EXPECT_EQ(remarks_on("45,45,200\n360,0,100\n", is_density), Remarks{});
    EXPECT_EQ(remarks_on("45,45,\n45,50,nan\n", is_density),
              Remarks{"2 of 8 places have no value: it is interpolated between the others"});
    EXPECT_EQ(remarks_on("-360,0,200\n77,90,300\n", is_density),
              Remarks{"2 of 8 places are at the place of another one with another value: of each "
                      "place the first value counts"});
  }
}

// Spacings of 100 on a grid of 5 degrees, and less in a dip around (0, 0).
std::string file_with_dip(double width) {
  const std::string path = temporary_path("dip.csv");
  std::ofstream file(path);
  file << "lon,lat,h\n";
  for (int lon = -180; lon < 180; lon += 5) {
    for (int lat = -85; lat <= 85; lat += 5) {
      file << lon << ',' << lat << ','
           << 100 - 60 * std::exp(-(lon * lon + lat * lat) / (width * width)) << '\n';
    }
  }
  return path;
}

TEST(mesh_spacing_files, have_a_raster_that_is_fine_enough) {
  std::vector<std::string> remarks;
  const auto dip = [&](double width, std::size_t most_steps) {
    remarks.clear();
    return 1e3 * read_spacings({file_with_dip(width), {}}, "h", 1e-3, 4, {}, &remarks,
                               {.most_steps = most_steps})
                     .spacing(unit_vector({10, 0}));
  };
  // The raster of 4 steps has nodes at (0, 0) and 27 degrees from there, where the dip ends.
  EXPECT_LT(dip(12, 0), 56);
  EXPECT_EQ(remarks, std::vector<std::string>{});
  EXPECT_NEAR(dip(12, 64), 70, 14);
  (void)dip(12, 4);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(
      remarks[0].substr(remarks[0].find(" places")),
      " places have another spacing by more than a fifth, since spacings are kept on a raster "
      "with steps of up to 3186 km");
  (void)dip(1e3, 4);
  EXPECT_EQ(remarks, std::vector<std::string>{});
}

TEST(mesh_spacing_files, tell_of_parts_of_the_sphere_without_places) {
  const std::string path = temporary_path("region.csv");
  std::ofstream(path) << "lon,lat,h\n0,0,100\n80,0,100\n0,90,200\n";
  std::vector<std::string> remarks;
  const auto read = [&](const std::vector<Point>& corners) {
    remarks.clear();
    (void)read_spacings({path, {}}, "h", 1e-3, 4, {}, &remarks, {.corners = corners});
    return remarks;
  };
  const std::vector<std::string> beyond = {
      "places with values surround 11 % of the sphere, and the mesh goes beyond: there the value "
      "of "
      "the nearest place counts"};
  EXPECT_EQ(read({}), beyond);
  EXPECT_EQ(read({{0.6, 0.6, 0.5}, {1, 0, 0}, {0.6, 0.5, 0.6}}), std::vector<std::string>{});
  EXPECT_EQ(read({{0.6, 0.6, 0.5}, {0.6, 0.5, -0.6}}), beyond);
  std::ofstream(path) << "lon,lat,h\n0,0,100\n90,0,100\n";
  EXPECT_EQ(read({}).front().substr(0, 46), "places with values surround 0 % of the sphere,");
}

TEST(mesh_spacing_files, names_the_line_and_column_of_a_table) {
  const std::string path = temporary_path("spacings_of_lines.csv");
  std::ofstream(path) << "lon,lat,h,d\n0,0,,1\n\n90,30,100,-2\n180,-30,-5,1\n";
  const auto message = [&](const auto& read) { return test::thrown_message<FileError>(read); };
  EXPECT_NE(message([&] {
              return read_spacings({path, {}}, "h", 1e-3, 16);
            }).find(path + ":5: spacing -5 of \"h\" is not positive"),
            std::string::npos);
  EXPECT_NE(message([&] {
              return read_density({path, {}}, "d", 16);
            }).find(path + ":4: density -2 of \"d\" is not positive"),
            std::string::npos);
}

}  // namespace
}  // namespace rondel::mesh
