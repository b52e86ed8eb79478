// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Circles in files: the radius column, and what is said of bad ones.
#include <numbers>

#include "rondel/delaunay.h"
#include "unit/io/support.h"

namespace rondel::test {
namespace {

ReadOptions radius_in(const std::string& column) {
  ReadOptions options;
  options.radius = column;
  return options;
}

TEST(read_circles, makes_polar_points_of_columns) {
  const TemporaryDirectory directory;
  const std::string file =
      directory.with("a.csv", "r,lon,lat\n0,10,20\n+30.5,-70,5\n89.9999,0,0\n");
  const SiteTable table = read_sites(file, radius_in(" R "));
  EXPECT_EQ(table.radii_deg, (std::vector<double>{0, 30.5, 89.9999}));
  EXPECT_EQ(table.positions, (std::vector<LonLat>{{10, 20}, {-70, 5}, {0, 0}}));
  EXPECT_EQ(table.sites, polar_points(table.positions, table.radii_deg));
  EXPECT_EQ(table.sites[0], unit_vector({10, 20}));
  EXPECT_TRUE(table.is_lonlat());
  EXPECT_TRUE(read_sites(file).radii_deg.empty()) << "only if it is named";
}

TEST(read_circles, makes_polar_points_of_directions) {
  const TemporaryDirectory directory;
  const std::string file = directory.with("a.tsv", "x\ty\tz\tr\n1\t0\t0\t60\n0\t6371\t0\t0\n");
  const SiteTable table = read_sites(file, radius_in("r"));
  EXPECT_EQ(table.sites, (std::vector<Point>{polar_point(Point{1, 0, 0}, 60), {0, 6371, 0}}));
  EXPECT_FALSE(table.is_lonlat());
}

TEST(read_circles, takes_properties) {
  const TemporaryDirectory directory;
  const std::string file =
      directory.with("a.geojson", R"({"type":"Feature","properties":{"reach":12.5,"R":"1"},
"geometry":{"type":"MultiPoint","coordinates":[[1,2],[3,4]]}})");
  ReadOptions options = radius_in("reach");
  options.keep_columns = true;
  const SiteTable table = read_sites(file, options);
  EXPECT_EQ(table.radii_deg, (std::vector<double>{12.5, 12.5}));
  EXPECT_EQ(table.sites, polar_points(table.positions, table.radii_deg));
  EXPECT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(read_sites(file, radius_in("R")).radii_deg, (std::vector<double>{1, 1}));
}

TEST(read_circles, takes_radians) {
  const TemporaryDirectory directory;
  ReadOptions options = radius_in("r");
  options.radians = true;
  const std::string file = directory.with("a.csv", "lon,lat,r\n0,0,0.5\n1,1,1.5707963267948963\n");
  const SiteTable table = read_sites(file, options);
  EXPECT_NEAR(table.radii_deg[0], 90 / std::numbers::pi, 1e-14);
  EXPECT_LT(table.radii_deg[1], 90);
  EXPECT_GT(table.radii_deg[1], 90 - 1e-13);
  const std::string right = directory.with("b.csv", "lon,lat,r\n0,0,1.5707963267948966\n");
  EXPECT_EQ(message_of([&] { read_sites(right, options); }),
            right + ":2: radius 1.5707963267948966 is not in [0, pi/2)");
}

TEST(read_circles, reads_the_corpus) {
  for (const char* const name : {"radius.csv", "radius.geojson"}) {
    const SiteTable table = read_sites((corpus / "good" / name).string(), radius_in("radius"));
    EXPECT_EQ(table.radii_deg.at(1), 12.5) << name;
    EXPECT_EQ(table.radii_deg.at(2), 89.9999) << name;
    EXPECT_EQ(table.sites, polar_points(table.positions, table.radii_deg)) << name;
  }
}

TEST(read_circles, says_which_radius_is_wrong) {
  const TemporaryDirectory directory;
  const auto message = [&](const std::string& name, const std::string& bytes) {
    const std::string file = directory.with(name, bytes);
    return message_of([&] { read_sites(file, radius_in("r")); }).substr(file.size());
  };
  EXPECT_EQ(message("a.csv", "lon,lat,r\n0,0,1\n\n0,0,95\n"), ":4: radius 95 is not in [0, 90)");
  EXPECT_EQ(message("a.csv", "lon,lat,r\n0,0,-1e-9\n"), ":2: radius -1e-09 is not in [0, 90)");
  EXPECT_EQ(message("a.csv", "lon,lat,r\n0,0,1,2\n"), ":2: 4 fields where the header has 3");

  EXPECT_EQ(message("a.csv", "lon,lat,R,R\n0,0,1,2\n"),
            ":1: more than one column may be the radius: \"R\" (column 3) and \"R\" (column 4)");
  EXPECT_EQ(message("a.csv", "lon,lat\n0,0\n"), ":1: no column \"r\"; found: lon, lat");
  EXPECT_EQ(message("a.xyz", "1 0 0\n"),
            ": a radius is named, but .xyz files have no names for columns; give weighted sites as "
            "x, y, z");
  EXPECT_EQ(message("a.geojson", R"({"type":"Point","coordinates":[0,0]})"),
            ":1: no property \"r\"");
  EXPECT_EQ(message("a.geojson", R"({"type":"Feature","properties":{"r":true},
"geometry":{"type":"Point","coordinates":[0,0]}})"),
            ":1: radius \"true\" is not a number");
}

TEST(write_circles, writes_positions_and_radii_or_polar_points) {
  const TemporaryDirectory directory;
  const std::vector<LonLat> positions = {{0.1, 1.0 / 3}, {-179.99999999999997, -90}};
  const std::vector<double> radii_deg = {0.1, 89.9999};
  const auto sites = polar_points(positions, radii_deg);
  for (const char* const name : {"a.csv", "a.tsv"}) {
    write_sites(directory.file(name), sites, positions, radii_deg);
    const SiteTable table = read_sites(directory.file(name), radius_in("radius"));
    EXPECT_EQ(table.positions, positions) << name;
    EXPECT_EQ(table.radii_deg, radii_deg) << name;
    EXPECT_EQ(table.sites, sites) << name;
  }
  for (const char* const name : {"a.npy", "a.xyz", "a.txt"}) {
    write_sites(directory.file(name), sites, positions, radii_deg);
    EXPECT_EQ(read_sites(directory.file(name)).sites, sites) << name;
  }
}

}  // namespace
}  // namespace rondel::test
