// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Bands and isolines as GeoJSON, read back.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "rondel/error.h"
#include "support/temporary_files.h"
#include "unit/interpolation/contours_support.h"
#include "unit/io/geojson_rings.h"
#include "unit/map/cells_planar.h"

namespace rondel::test {
namespace {

TEST(write_bands, covers_the_map_once_for_every_generator) {
  const std::string path = temporary_path("bands.geojson");
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    const Triangulation t = projected(generator.make(200, 3));
    const std::vector<double> values = smooth_values(t);
    const Bands found = bands(t, values, std::vector<double>{-0.7, -0.1, 0.2, 0.9, 1.4});
    write_bands(path, found, 0.001);
    double expected = 0;
    for (std::size_t i = 0; i < found.num_polygons(); ++i) expected += polygon_area(found, i);
    double area = 0;
    for (const Ring& ring : checked_rings(read_json(path), generator.name)) {
      area += spherical_area(ring);
    }
    // Of a polygon as wide as rounding nobody knows whether it has nothing or all.
    EXPECT_NEAR(std::remainder(area - expected, 4 * std::numbers::pi), 0, 1e-4) << generator.name;
    EXPECT_LT(area, 4 * std::numbers::pi + 1e-4);
  }
}

TEST(write_bands, has_the_whole_map_where_there_is_one_band) {
  const std::string path = temporary_path("whole.geojson");
  const Triangulation t = projected(generator("uniform").make(20, 3));
  write_bands(path, bands(t, std::vector<double>(20, 1.0), std::vector<double>{0}));
  const auto document = read_json(path);
  EXPECT_TRUE(document["features"][0]["geometry"].is_null());
  EXPECT_EQ(document["features"][1]["properties"]["low"], 0);
  EXPECT_TRUE(document["features"][1]["properties"]["high"].is_null());
  EXPECT_EQ(ring_of(document["features"][1]["geometry"]["coordinates"][0][0]),
            (Ring{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}, {-180, -90}}));
}

// The lines around a region that is smaller than the distance of equal points are gone: its complement is the map.
TEST(write_bands, gives_the_map_to_the_band_without_lines_that_has_it) {
  const std::string path = temporary_path("tiny.geojson");
  constexpr double tiny = 4e-15;
  const std::vector<Point> sites = {{1, 0, 0},         {1, tiny, 0},   {1, 0, tiny},
                                    {1, -tiny, -tiny}, {-1, 0.1, 0.2}, {0, 1, 0.1},
                                    {0.1, -1, 0},      {0, 0.1, 1},    {0.1, 0.05, -1}};
  const Triangulation t = delaunay(sites);
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> values(sites.size(), 0);
    values[0] = sign;
    const Bands found = bands(t, values, std::vector<double>{sign / 2});
    ASSERT_EQ(found.num_polygons(), 2U);
    write_bands(path, found);
    const auto document = read_json(path);
    const std::size_t rest = sign > 0 ? 0 : 1;
    EXPECT_EQ(ring_of(document["features"][rest]["geometry"]["coordinates"][0][0]),
              (Ring{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}, {-180, -90}}));
    EXPECT_TRUE(document["features"][1 - rest]["geometry"].is_null()) << document.dump();
  }
}

// Lines around both poles, and one across the antimeridian.
TEST(write_isolines, cuts_lines_at_the_antimeridian) {
  const std::string path = temporary_path("lines.geojson");
  const Triangulation t = projected(generator("uniform").make(500, 3));
  std::vector<double> values;
  for (const Point& site : t.sites().points()) values.push_back(site.z);
  write_isolines(path, isolines(t, values, std::vector<double>{-0.5, 0, 0.5, 2}));
  const auto document = read_json(path);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& lines = document["features"][k]["geometry"]["coordinates"];
    ASSERT_EQ(lines.size(), 1U);
    const Ring line = ring_of(lines[0]);
    // The higher values are in the north: from west to east.
    EXPECT_EQ(line.front().lon_deg, -180);
    EXPECT_EQ(line.back().lon_deg, 180);
    EXPECT_EQ(line.front().lat_deg, line.back().lat_deg);
  }
  EXPECT_EQ(document["features"][1]["properties"]["level"], 0);
  EXPECT_TRUE(document["features"][3]["geometry"].is_null());
}

TEST(write_isolines, ends_lines_at_the_border_and_passes_a_pole) {
  const std::string path = temporary_path("open.geojson");
  // A line along the meridians 0 and 180 over the north pole.
  const std::vector<Point> sites{{1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}};
  const Triangulation t = delaunay(sites);
  write_isolines(path, isolines(t, std::vector<double>{1, 1, -1, -1}, std::vector<double>{0}));
  const auto document = read_json(path);
  const auto& lines = document["features"][0]["geometry"]["coordinates"];
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(ring_of(lines[0]).back().lat_deg, 90);
  EXPECT_EQ(ring_of(lines[1]).front().lat_deg, 90);
}

TEST(contours, are_not_written_if_their_arrays_do_not_fit) {
  Bands bad;
  EXPECT_THROW(write_bands("no.geojson", bad), InvalidInput);  // one band, and offsets of none
  Isolines lines;
  EXPECT_THROW(write_isolines("no.xyz", lines), FileError);
  EXPECT_THROW(write_isolines("no.geojson", lines, 0), InvalidInput);
  lines.is_closed = {1};
  EXPECT_THROW(write_isolines("no.geojson", lines), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
