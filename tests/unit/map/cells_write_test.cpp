// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The files of cells, read by programs that know nothing of this library.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "support/generators.h"
#include "support/temporary_files.h"

namespace rondel::test {
namespace {

std::string file_name(const std::string& name) { return temporary_path("cells_") + name; }

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Column column(const std::string& name, bool is_numeric, const std::vector<std::string>& cells) {
  Column result;
  result.name = name;
  result.is_numeric = is_numeric;
  for (const std::string& cell : cells) {
    result.text += cell;
    result.ends.push_back(result.text.size());
  }
  return result;
}

SiteTable table_of(const std::vector<LonLat>& positions) {
  SiteTable table;
  table.name = "test";
  table.positions = positions;
  table.sites = unit_vectors(positions);
  std::vector<std::string> lon;
  std::vector<std::string> lat;
  for (const LonLat& position : positions) {
    lon.push_back(nlohmann::json(position.lon_deg).dump());
    lat.push_back(nlohmann::json(position.lat_deg).dump());
  }
  table.columns = {column("lon", true, lon), column("lat", true, lat)};
  return table;
}

void write(const std::string& path, const SiteTable& table, const Options& options = {}) {
  const Triangulation triangulation = delaunay(table.sites, options);
  Diagram diagram;
  diagram.cells = cells(triangulation);
  diagram.areas = areas(triangulation);
  write_cells(path, table, triangulation, diagram);
}

std::vector<LonLat> random_positions(std::size_t n, const LonLat& center, double spread_deg) {
  Random random(n);
  std::vector<LonLat> positions(n);
  for (LonLat& p : positions) {
    p.lon_deg = center.lon_deg + spread_deg * random.signed_unit();
    p.lat_deg = std::clamp(center.lat_deg + spread_deg / 2 * random.signed_unit(), -90.0, 90.0);
    if (p.lon_deg > 180) p.lon_deg -= 360;
  }
  return positions;
}

// A Python that has the module; empty if there is none. Debian's packages belong to /usr/bin.
std::string python_with(const std::string& module) {
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    const std::string command = python + " -c 'import " + module + "' 2>/dev/null";
    if (std::system(command.c_str()) == 0) return python;
  }
  return "";
}

TEST(write_cells, geojson_has_a_feature_a_cell_with_all_columns) {
  SiteTable table = table_of({{0, 0}, {90, 0}, {0, 0}, {0, 90}, {-120, -45}});
  table.columns = {column("name", false, {"a", "", "b", "c \"d\"\n\\", "\xC3\xA9"}),
                   column("height", true, {"1.50", "-2e3", "3", "", "0"}),
                   column("site", true, {"7", "8", "9", "10", "11"}),
                   column("site", true, {"17", "18", "19", "20", "21"}),
                   column("area", false, {"x", "y", "z", "u", "v"})};
  const std::string path = file_name("columns.geojson");
  write(path, table);
  const auto collection = nlohmann::json::parse(content(path));
  EXPECT_EQ(collection["type"], "FeatureCollection");
  const auto& features = collection["features"];
  ASSERT_EQ(features.size(), 4U);  // site 2 is a duplicate
  EXPECT_EQ(features[1]["properties"]["site"], 1);
  EXPECT_EQ(features[2]["properties"]["site"], 3);
  EXPECT_EQ(features[1]["properties"]["name"], nullptr);
  EXPECT_EQ(features[2]["properties"]["name"], "c \"d\"\n\\");
  EXPECT_EQ(features[3]["properties"]["name"], "\xC3\xA9");
  EXPECT_EQ(features[0]["properties"]["height"], 1.5);
  EXPECT_EQ(features[2]["properties"]["height"], nullptr);
  EXPECT_EQ(features[0]["properties"]["site_"], 7);
  EXPECT_EQ(features[0]["properties"]["site__"], 17);
  EXPECT_EQ(features[0]["properties"]["area_"], "x");
  EXPECT_TRUE(features[0]["properties"]["area"].is_number());
  EXPECT_NE(content(path).find("\"height\":1.50"), std::string::npos);
}

TEST(write_cells, one_site_is_the_whole_sphere) {
  const std::string path = file_name("one.geojson");
  write(path, table_of({{10, 20}}));
  const auto collection = nlohmann::json::parse(content(path));
  EXPECT_EQ(collection["features"][0]["geometry"]["coordinates"],
            nlohmann::json::parse("[[[-180,-90],[180,-90],[180,90],[-180,90],[-180,-90]]]"));
}

TEST(write_cells, no_sites_no_features) {
  const std::string path = file_name("none.geojson");
  write(path, table_of({}));
  EXPECT_TRUE(nlohmann::json::parse(content(path))["features"].empty());
  for (const char* const name : {"none.vtp", "none.npz"}) {
    write(file_name(name), table_of({}));
    EXPECT_GT(content(file_name(name)).size(), 100U);
  }
}

TEST(write_cells, endings) {
  EXPECT_TRUE(can_write_cells("a.geojson"));
  EXPECT_TRUE(can_write_cells("a.VTP"));
  EXPECT_TRUE(can_write_cells("a.npz"));
  EXPECT_FALSE(can_write_cells("a.npy"));
  EXPECT_THROW(write("cells.dat", table_of({{0, 0}})), FileError);
  EXPECT_THROW(write("/nonexistent/cells.npz", table_of({{0, 0}})), FileError);
}

TEST(write_cells, geojson_is_valid_by_shapely) {
  const std::string python = python_with("shapely");
  if (python.empty()) GTEST_SKIP() << "python3-shapely is not installed";
  const std::vector<std::pair<std::string, std::vector<LonLat>>> inputs{
      {"one", {{10, 20}}},
      {"poles", {{0, 90}, {0, -90}}},
      {"pair", {{10, 20}, {10.0001, 20}}},
      {"antimeridian_pair", {{180, 5}, {179.9999, 5}, {-179.9999, 5}}},
      {"equator", {{0, 0}, {120, 0}, {-120, 0}}},
      {"octahedron", {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}}},
      {"globe", random_positions(2000, {0, 0}, 180)},
      {"region", random_positions(300, {8, 47}, 3)},
      {"north", random_positions(300, {0, 90}, 180)},
      {"date_line", random_positions(300, {180, -20}, 1e-3)}};
  for (const auto& [name, positions] : inputs) {
    const std::string path = file_name(name + ".geojson");
    write(path, table_of(positions));
    const std::string command =
        python + " " RONDEL_SOURCE_DIR "/tests/support/validate_geojson.py '" + path + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
  }
}

TEST(write_cells, geojson_of_power_cells_is_valid_by_shapely) {
  const std::string python = python_with("shapely");
  if (python.empty()) GTEST_SKIP() << "python3-shapely is not installed";
  struct Input {
    const char* name;
    std::vector<LonLat> positions;
    double largest_deg;
  };
  const std::vector<Input> inputs{{"globe", random_positions(2000, {0, 0}, 180), 30},
                                  {"small", random_positions(2000, {0, 0}, 180), 1},
                                  {"huge", random_positions(300, {0, 0}, 180), 89.9999},
                                  {"region", random_positions(300, {8, 47}, 3), 1},
                                  {"north", random_positions(300, {0, 90}, 60), 20},
                                  {"date_line", random_positions(300, {180, -20}, 10), 5}};
  for (const auto& [name, positions, largest_deg] : inputs) {
    Random random(17);
    std::vector<double> radii_deg(positions.size());
    for (double& radius_deg : radii_deg) radius_deg = largest_deg * random.unit();
    SiteTable table = table_of(positions);
    table.sites = polar_points(positions, radii_deg);
    const std::string path = file_name(std::string("power_") + name + ".geojson");
    write(path, table, {.model = Model::weighted});
    const std::string command =
        python + " " RONDEL_SOURCE_DIR "/tests/support/validate_geojson.py --power '" + path + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << name;
  }
}

// The archive and its arrays are what NumPy and Python's zipfile take for them.
TEST(write_cells, npz_opens_in_numpy) {
  const std::string python = python_with("numpy");
  if (python.empty()) GTEST_SKIP() << "python3-numpy is not installed";
  const std::string path = file_name("globe.npz");
  write(path, table_of(random_positions(500, {0, 0}, 180)));
  const std::string script = file_name("check.py");
  std::ofstream(script) << R"(import sys, math, zipfile, numpy
assert zipfile.ZipFile(sys.argv[1]).testzip() is None
a = numpy.load(sys.argv[1])
assert sorted(a) == ['areas', 'faces', 'hidden', 'offsets', 'points', 'rings'], sorted(a)
assert a['offsets'].dtype == 'u8' and a['offsets'].shape == (501,)
assert a['rings'].dtype == 'u4' and a['rings'].shape == (a['offsets'][-1],)
assert a['points'].dtype == 'f8' and a['points'].shape == (2 * 500 - 4, 3)
assert abs(numpy.linalg.norm(a['points'], axis=1) - 1).max() < 1e-15
assert abs(a['areas'].sum() / (4 * math.pi) - 1) < 1e-12
assert a['faces'].dtype == 'u4' and a['faces'].shape == (2 * 500 - 4, 3)
assert a['hidden'].dtype == 'u4' and a['hidden'].shape == (0, 2)
)";
  EXPECT_EQ(std::system((python + " '" + script + "' '" + path + "'").c_str()), 0);
}

// What is hidden has no cell; both formats that can name it, with a face above it, do.
TEST(write_cells, names_hidden_sites) {
  SiteTable table;
  table.name = "hidden.csv";
  table.sites = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0},        {0, -2, 0},
                 {0, 0, 2}, {0, 0, -2}, {1, 0.25, 0.125}, {0, 0, -1.5}};
  const Triangulation triangulation = delaunay(table.sites, {.model = Model::weighted});
  const Diagram cells = diagram(triangulation);
  write_cells(file_name("hidden.geojson"), table, triangulation, cells);
  const auto json = nlohmann::json::parse(content(file_name("hidden.geojson")));
  EXPECT_EQ(json["features"].size(), 6U);
  ASSERT_EQ(json["hidden"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [site, face] = triangulation.hidden()[i];
    EXPECT_EQ(json["hidden"][i]["site"], site);
    EXPECT_EQ(json["hidden"][i]["below"], triangulation.faces()[face]);
  }
  EXPECT_EQ(json["hidden"][0]["site"], 6);
  const std::string path = file_name("hidden.npz");
  write_cells(path, table, triangulation, cells);
  const std::string bytes = content(path);
  const auto member = bytes.find("hidden.npy");
  const auto pairs = bytes.find("PK", member) - sizeof(Hidden) * 2;
  EXPECT_EQ(std::memcmp(bytes.data() + pairs, triangulation.hidden().data(), sizeof(Hidden) * 2),
            0);
}

TEST(write_cells, vtp_describes_its_bytes) {
  const std::string path = file_name("globe.vtp");
  write(path, table_of(random_positions(500, {0, 0}, 180)));
  const std::string text = content(path);
  EXPECT_NE(text.find(R"(NumberOfPoints="996" NumberOfPolys="500")"), std::string::npos);
  const std::size_t raw = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
  // site, area, points, connectivity (6 V - 12 corners), offsets; each after its length
  const std::size_t expected = 5 * 8 + 8 * (500 + 500 + 3 * 996 + (6 * 500 - 12) + 500);
  EXPECT_EQ(text.find("\n</AppendedData>", raw + expected), raw + expected);
}

}  // namespace
}  // namespace rondel::test
