// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of cells that contradict themselves: corners that are no nodes, and centers of other cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "rondel/weight_files.h"
#include "support/temporary_files.h"
#include "unit/meshing/writer.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

using Values = std::vector<double>;
using Remarks = std::vector<std::string>;

// Cells with one ring each, as a file has them.
struct RingsOfFile {
  std::vector<LonLat> nodes;
  std::vector<std::vector<std::size_t>> rings;
  std::vector<LonLat> centers;

  void add_cell(const std::vector<LonLat>& corners, const LonLat& center) {
    auto& ring = rings.emplace_back();
    for (const LonLat& corner : corners) {
      ring.push_back(nodes.size());
      nodes.push_back(corner);
    }
    centers.push_back(center);
  }
  [[nodiscard]] std::size_t most() const {
    std::size_t found = 0;
    for (const auto& ring : rings) found = std::max(found, ring.size());
    return found;
  }
  // Numbers of nodes from `first` on, with rows filled up.
  [[nodiscard]] Values entries(double first, double filling) const {
    Values values;
    for (const auto& ring : rings) {
      for (std::size_t k = 0; k < most(); ++k) {
        values.push_back(k < ring.size() ? static_cast<double>(ring[k]) + first : filling);
      }
    }
    return values;
  }
  [[nodiscard]] Values counts() const {
    Values values;
    for (const auto& ring : rings) values.push_back(static_cast<double>(ring.size()));
    return values;
  }
};

// The cells of sites with the sites as centers, whose numbers have nothing to do with their places.
RingsOfFile rings_of_sites(std::size_t n, std::uint64_t seed) {
  const Triangulation sites = triangulation_of("uniform", n, seed);
  const Cells all = cells(sites);
  RingsOfFile mesh;
  mesh.nodes = lonlats(all.points);
  for (std::size_t i = 0; i < n; ++i) {
    mesh.rings.emplace_back(all.rings[i].begin(), all.rings[i].end());
    const Point& site = sites.sites()[i];
    mesh.centers.push_back(lonlats({&site, 1}).front());
  }
  return mesh;
}

// The faces of a triangulation with their circumcenters, of which many are outside.
RingsOfFile triangles_of_sites(std::size_t n, std::uint64_t seed) {
  const Triangulation sites = triangulation_of("uniform", n, seed);
  RingsOfFile mesh;
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(sites.sites()[i]);
  mesh.nodes = lonlats(points);
  std::vector<Point> centers;
  for (const auto& face : sites.faces()) {
    mesh.rings.push_back({face[0], face[1], face[2]});
    centers.push_back(normalized(
        exact::cross(points[face[1]] - points[face[0]], points[face[2]] - points[face[0]])));
  }
  mesh.centers = lonlats(centers);
  return mesh;
}

// A grid of meridians and parallels, polygons with two corners at a pole among its cells.
RingsOfFile lonlat_rings(double step) {
  RingsOfFile mesh;
  for (double lat = -90; lat < 90; lat += step) {
    for (double lon = 0; lon < 360; lon += step) {
      mesh.add_cell({{lon, lat}, {lon + step, lat}, {lon + step, lat + step}, {lon, lat + step}},
                    {lon + step / 2 - (lon > 180 ? 360 : 0), lat + step / 2});
    }
  }
  return mesh;
}

template <class Coordinate>
Values of_places(const std::vector<LonLat>& places, const Coordinate& coordinate) {
  Values values;
  for (const LonLat& place : places) values.push_back(place.*coordinate);
  return values;
}

using Change = std::function<void(Values& entries, Values& counts)>;
void no_change(Values& /*entries*/, Values& /*counts*/) {}

MeshWriter esmf_of(const RingsOfFile& mesh, const Change& change = no_change,
                   const Values& mask = {}) {
  const auto pairs = [](const std::vector<LonLat>& places) {
    Values values;
    for (const LonLat& place : places) {
      values.insert(values.end(), {place.lon_deg, place.lat_deg});
    }
    return values;
  };
  Values entries = mesh.entries(1, -1);
  Values counts = mesh.counts();
  change(entries, counts);
  MeshWriter file;
  const std::size_t n = mesh.rings.size();
  file.add("nodeCoords", {{"nodeCount", mesh.nodes.size()}, {"coordDim", 2}}, pairs(mesh.nodes),
           {{"units", "degrees"}});
  file.add("centerCoords", {{"elementCount", n}, {"coordDim", 2}}, pairs(mesh.centers),
           {{"units", "degrees"}});
  file.add_whole("elementConn", {{"elementCount", n}, {"maxNodePElement", mesh.most()}}, entries,
                 {}, {{"_FillValue", -1}});
  file.add_whole("numElementConn", {{"elementCount", n}}, counts);
  if (!mask.empty()) file.add_whole("elementMask", {{"elementCount", n}}, mask);
  return file;
}

MeshWriter ugrid_of(const RingsOfFile& mesh, const Change& change = no_change) {
  Values entries = mesh.entries(0, -1);
  Values counts;
  change(entries, counts);
  MeshWriter file;
  file.add_whole("mesh", {}, {0},
                 {{"cf_role", "mesh_topology"},
                  {"node_coordinates", "node_x node_y"},
                  {"face_coordinates", "face_x face_y"},
                  {"face_node_connectivity", "face_nodes"}},
                 {{"topology_dimension", 2}});
  const auto add = [&](const char* dimension, const std::string& of,
                       const std::vector<LonLat>& places) {
    file.add(of + "_x", {{dimension, places.size()}}, of_places(places, &LonLat::lon_deg),
             {{"units", "degrees_east"}});
    file.add(of + "_y", {{dimension, places.size()}}, of_places(places, &LonLat::lat_deg),
             {{"units", "degrees_north"}});
  };
  add("nodes", "node", mesh.nodes);
  add("faces", "face", mesh.centers);
  file.add_whole("face_nodes", {{"faces", mesh.rings.size()}, {"corners", mesh.most()}}, entries,
                 {}, {{"_FillValue", -1}, {"start_index", 0}});
  return file;
}

MeshWriter scrip_of(const RingsOfFile& mesh, const Values& mask = {}) {
  MeshWriter file;
  std::vector<LonLat> corners;
  for (const auto& ring : mesh.rings) {
    for (std::size_t k = 0; k < mesh.most(); ++k) {
      corners.push_back(mesh.nodes[ring[std::min(k, ring.size() - 1)]]);
    }
  }
  const std::size_t n = mesh.rings.size();
  const MeshWriter::Texts degrees = {{"units", "degrees"}};
  for (const auto& [name, coordinate] :
       {std::pair{std::string("lon"), &LonLat::lon_deg}, {std::string("lat"), &LonLat::lat_deg}}) {
    file.add("grid_corner_" + name, {{"grid_size", n}, {"grid_corners", mesh.most()}},
             of_places(corners, coordinate), degrees);
    file.add("grid_center_" + name, {{"grid_size", n}}, of_places(mesh.centers, coordinate),
             degrees);
  }
  if (!mask.empty()) file.add_whole("grid_imask", {{"grid_size", n}}, mask);
  return file;
}

MeshWriter mpas_of(const RingsOfFile& mesh, const Change& change) {
  Values entries = mesh.entries(1, 0);
  Values counts = mesh.counts();
  change(entries, counts);
  MeshWriter file;
  const std::size_t n = mesh.rings.size();
  const MeshWriter::Dimensions vertices = {{"nVertices", mesh.nodes.size()}};
  file.add("lonVertex", vertices, of_places(mesh.nodes, &LonLat::lon_deg), {{"units", "degrees"}});
  file.add("latVertex", vertices, of_places(mesh.nodes, &LonLat::lat_deg), {{"units", "degrees"}});
  file.add_whole("verticesOnCell", {{"nCells", n}, {"maxEdges", mesh.most()}}, entries);
  file.add_whole("nEdgesOnCell", {{"nCells", n}}, counts);
  return file;
}

MeshWriter exodus_of(const RingsOfFile& mesh, const Change& change) {
  Values entries = mesh.entries(1, 0);
  Values counts;
  change(entries, counts);
  std::vector<Point> points = unit_vectors(mesh.nodes);
  MeshWriter file;
  for (const auto& [name, axis] :
       {std::pair{"coordx", &Point::x}, {"coordy", &Point::y}, {"coordz", &Point::z}}) {
    Values values;
    for (const Point& p : points) values.push_back(p.*axis);
    file.add(name, {{"num_nodes", points.size()}}, values);
  }
  file.add_whole("connect1",
                 {{"num_el_in_blk1", mesh.rings.size()}, {"num_nod_per_el1", mesh.most()}},
                 entries);
  return file;
}

std::string path_of_faults() {
  return temporary_path("mesh_faults_") +
         testing::UnitTest::GetInstance()->current_test_info()->name() + ".nc";
}
CellTable cells_read(const MeshWriter& writer) {
  writer.write(path_of_faults());
  return read_cells(path_of_faults());
}
// Returns the message without the name of the file, or an empty text.
std::string fault_of(const MeshWriter& writer) {
  try {
    (void)cells_read(writer);
  } catch (const FileError& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with(path_of_faults() + ": ")) << what;
    return what.substr(std::min(what.size(), path_of_faults().size() + 2));
  }
  return "";
}

// Two cells of six corners around the meridians 10 and 40, and one of four corners.
RingsOfFile three_cells() {
  RingsOfFile mesh;
  for (const double lon : {10.0, 40.0}) {
    mesh.add_cell(
        {{lon - 4, -5}, {lon + 4, -5}, {lon + 8, 0}, {lon + 4, 5}, {lon - 4, 5}, {lon - 8, 0}},
        {lon, 0});
  }
  mesh.add_cell({{60, 0}, {70, 0}, {70, 10}, {60, 10}}, {65, 5});
  return mesh;
}

TEST(overlay_mesh_faults, corners_that_are_no_nodes_are_refused) {
  const RingsOfFile mesh = three_cells();
  const auto set = [](std::size_t corner, double number) {
    return [=](Values& entries, Values&) { entries[6 + corner] = number; };
  };
  const auto said = [](const std::string& number, const std::string& corner,
                       const std::string& where, const std::string& why) {
    return "cell 1 has the number " + number + ", which is no node, as corner " + corner +
           " in \"" + where + "\", " + why;
  };
  const std::string counted = "though it has 6 corners";
  const std::string before = "before other corners";
  for (const std::size_t corner : {0U, 2U, 5U}) {
    const std::string place = std::to_string(corner);
    EXPECT_EQ(fault_of(esmf_of(mesh, set(corner, 0))), said("0", place, "elementConn", counted));
    EXPECT_EQ(fault_of(esmf_of(mesh, set(corner, -1))), said("-1", place, "elementConn", counted));
    EXPECT_EQ(fault_of(mpas_of(mesh, set(corner, 0))), said("0", place, "verticesOnCell", counted));
    EXPECT_EQ(fault_of(mpas_of(mesh, set(corner, -2147483647))),
              said("-2147483647", place, "verticesOnCell", counted));
    if (corner == 5) continue;
    EXPECT_EQ(fault_of(ugrid_of(mesh, set(corner, -1))), said("-1", place, "face_nodes", before));
    EXPECT_EQ(fault_of(ugrid_of(mesh, set(corner, -3))), said("-3", place, "face_nodes", before));
    EXPECT_EQ(fault_of(exodus_of(mesh, set(corner, 0))), said("0", place, "connect1", before));
  }
  EXPECT_EQ(fault_of(esmf_of(mesh, set(3, 17))),
            "cell 1 has a corner 17 of 16 nodes in \"elementConn\"");
}

TEST(overlay_mesh_faults, counts_of_corners_that_are_too_large_or_no_numbers_are_refused) {
  const RingsOfFile mesh = three_cells();
  const auto count = [](double number) {
    return [=](Values&, Values& counts) { counts[2] = number; };
  };
  EXPECT_EQ(fault_of(esmf_of(mesh, count(5))),
            "cell 2 has the number -1, which is no node, as corner 4 in \"elementConn\", though it "
            "has 5 corners");
  EXPECT_EQ(fault_of(mpas_of(mesh, count(7))), "cell 2 has 7 corners of 6");
}

TEST(overlay_mesh_faults, rows_that_are_filled_up_are_read) {
  const RingsOfFile mesh = three_cells();
  EXPECT_EQ(cells_read(ugrid_of(mesh)).facts.remarks, Remarks{});
  EXPECT_EQ(cells_read(esmf_of(mesh)).facts.remarks, Remarks{});
  EXPECT_EQ(cells_read(mpas_of(mesh, no_change)).facts.remarks, Remarks{});
  const CellTable elements = cells_read(exodus_of(mesh, no_change));
  EXPECT_EQ(elements.facts.remarks,
            Remarks{"2 numbers of \"connect1\" are less than 1 and taken for no "
                    "corners, though no _FillValue says so"});
  EXPECT_EQ(elements.cells.rings.back(), 16U);
  // Behind its corners a row may repeat one of them.
  const auto repeated = [](Values& entries, Values&) { entries[16] = entries[17] = 16; };
  EXPECT_EQ(cells_read(mpas_of(mesh, repeated)).facts.remarks, Remarks{});
  EXPECT_EQ(cells_read(esmf_of(mesh, repeated)).facts.remarks, Remarks{});
}

TEST(overlay_mesh_faults, further_corners_behind_the_count_and_cells_without_corners_are_told) {
  const RingsOfFile mesh = three_cells();
  const auto fewer = [](Values&, Values& counts) { counts[1] = 5; };
  const auto told = [](const std::string& name) {
    return Remarks{"1 of 3 cells have further corners in \"" + name +
                   "\" behind the number of corners that they are said to have, the first one "
                   "cell 1"};
  };
  EXPECT_EQ(cells_read(esmf_of(mesh, fewer)).facts.remarks, told("elementConn"));
  EXPECT_EQ(cells_read(mpas_of(mesh, fewer)).facts.remarks, told("verticesOnCell"));
  const auto nothing = [](Values& entries, Values&) {
    std::fill(entries.begin() + 6, entries.begin() + 12, -1);
  };
  const Remarks empty = {"1 of 3 cells have fewer than three different corners and are empty"};
  EXPECT_EQ(cells_read(esmf_of(mesh, nothing)).facts.remarks, empty);
  EXPECT_EQ(cells_read(ugrid_of(mesh, nothing)).facts.remarks, empty);
}

TEST(overlay_mesh_faults, masked_cells_may_have_any_corners_and_centers) {
  RingsOfFile mesh = three_cells();
  mesh.centers[1] = {-170, -80};
  const auto anything = [](Values& entries, Values&) {
    entries[7] = -5;
    entries[8] = 0;
    entries[10] = 900;
  };
  const Remarks masked = {"1 of 3 cells are masked by \"elementMask\""};
  EXPECT_EQ(cells_read(esmf_of(mesh, anything, {1, 0, 1})).facts.remarks, masked);
  EXPECT_EQ(cells_read(scrip_of(mesh, {1, 0, 1})).facts.remarks,
            Remarks{"1 of 3 cells are masked by \"grid_imask\""});
  EXPECT_NE(fault_of(esmf_of(mesh, anything, {0, 1, 0})), "");
}

void expect_own_centers(const RingsOfFile& mesh) {
  for (const MeshWriter& file : {esmf_of(mesh), ugrid_of(mesh), scrip_of(mesh)}) {
    const CellTable table = cells_read(file);
    EXPECT_EQ(table.facts.remarks, Remarks{}) << table.facts.convention;
    EXPECT_EQ(table.facts.centers.size(), mesh.rings.size());
  }
}

TEST(overlay_mesh_faults, centers_of_sound_cells_pass) {
  for (const std::size_t n : {4U, 6U, 40U, 2000U}) expect_own_centers(rings_of_sites(n, n));
  expect_own_centers(triangles_of_sites(600, 7));
  for (const double step : {90.0, 30.0, 2.5}) expect_own_centers(lonlat_rings(step));
  RingsOfFile mesh;
  // The first corner as the center, an L with its center in the gap, a cap and a cell at the pole.
  mesh.add_cell({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {0, 0});
  mesh.add_cell({{10, 0}, {20, 0}, {20, 1}, {11, 1}, {11, 10}, {10, 10}}, {14, 4});
  mesh.add_cell({{0, -60}, {-90, -60}, {180, -60}, {90, -60}}, {77, -90});
  mesh.add_cell({{0, 89}, {120, 89}, {-120, 89}}, {0, 90});
  expect_own_centers(mesh);
}

TEST(overlay_mesh_faults, centers_of_other_cells_are_refused) {
  for (const RingsOfFile& sound : {rings_of_sites(40, 3), lonlat_rings(10), three_cells()}) {
    for (const std::size_t by : {std::size_t{1}, sound.rings.size() / 2}) {
      RingsOfFile mesh = sound;
      std::rotate(mesh.centers.begin(), mesh.centers.begin() + static_cast<std::ptrdiff_t>(by),
                  mesh.centers.end());
      EXPECT_TRUE(
          fault_of(esmf_of(mesh))
              .starts_with("centers belong to other cells than the corners in \"nodeCoords\": "));
      EXPECT_TRUE(
          fault_of(ugrid_of(mesh))
              .starts_with(
                  "centers belong to other cells than the corners in \"node_x\" and \"node_y\": "));
      EXPECT_TRUE(
          fault_of(scrip_of(mesh))
              .starts_with(
                  "centers belong to other cells than the corners in \"grid_corner_lon\" and "
                  "\"grid_corner_lat\": "));
    }
  }
  // One of many, far away.
  RingsOfFile mesh = lonlat_rings(10);
  mesh.centers[100] = {0, 0};
  EXPECT_EQ(fault_of(scrip_of(mesh)),
            "centers belong to other cells than the corners in \"grid_corner_lon\" and "
            "\"grid_corner_lat\": 1 of 648 centers of cells in \"grid_center_lon\" and "
            "\"grid_center_lat\" are outside of their corners, such as that of cell 100, longitude "
            "0 and latitude 0, with a corner at longitude 280 and latitude -70");
}

TEST(overlay_mesh_faults, centers_beside_their_cells_are_told) {
  RingsOfFile mesh = lonlat_rings(10);
  std::swap(mesh.centers[300], mesh.centers[301]);
  const Remarks remarks = cells_read(ugrid_of(mesh)).facts.remarks;
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_TRUE(remarks[0].starts_with(
      "2 of 648 centers of cells in \"face_x\" and \"face_y\" are outside of their corners, the "
      "first one that of cell 300, longitude "))
      << remarks[0];
  // Narrow pieces may keep the center of the cell that they are cut from.
  RingsOfFile cut = lonlat_rings(10);
  for (const std::size_t k : {1U, 2U}) {
    LonLat& corner = cut.nodes[cut.rings[300][k]];
    corner.lon_deg = cut.nodes[cut.rings[300][0]].lon_deg + 0.01;
  }
  cut.nodes[cut.rings[300][2]].lat_deg = cut.nodes[cut.rings[300][1]].lat_deg + 0.01;
  cut.nodes[cut.rings[300][3]].lat_deg = cut.nodes[cut.rings[300][0]].lat_deg + 0.01;
  EXPECT_EQ(cells_read(scrip_of(cut)).facts.remarks.size(), 1U);
}

}  // namespace
}  // namespace rondel::test
