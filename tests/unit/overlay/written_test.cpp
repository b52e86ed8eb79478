// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of regions as GeoJSON, read back.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "rondel/error.h"
#include "rondel/regions.h"
#include "support/temporary_files.h"
#include "unit/io/geojson_rings.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

double planar_sum(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& ring : rings) sum += planar_area(ring);
  return sum;
}

TEST(overlay_written, groups_cover_the_map_once) {
  const std::string path = temporary_path("groups.geojson");
  for (const std::size_t n : {8U, 50U, 2000U}) {
    const CellSet cells = CellSet::voronoi(triangulation_of("uniform", n, 3));
    const CellRings joined = dissolve(cells.rings(), random_groups(n, 3, n), 3);
    write_regions(path, joined);
    const auto document = read_json(path);
    EXPECT_NEAR(planar_sum(checked_rings(document, "groups")), 360.0 * 180.0, 1e-6) << n;
    const std::vector<double> expected = areas(joined);
    for (std::size_t g = 0; g < 3; ++g) {
      EXPECT_NEAR(document["features"][g]["properties"]["area"].get<double>(), expected[g], 1e-13);
    }
  }
}

TEST(overlay_written, arrays_have_the_polygons_of_the_file) {
  const std::string path = temporary_path("arrays.geojson");
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 300, 9));
  const CellRings joined = dissolve(cells.rings(), random_groups(300, 3, 9), 3);
  write_regions(path, joined);
  const LonLatRegions drawn = region_polygons(joined);
  ASSERT_EQ(drawn.owners.size() + 1, drawn.polygons.offsets.size());
  EXPECT_TRUE(std::ranges::is_sorted(drawn.owners));
  std::size_t polygon = 0;
  std::size_t num_holes = 0;
  const auto document = read_json(path);
  ASSERT_EQ(document["features"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& geometry = document["features"][i]["geometry"];
    const auto parts = geometry["type"] == "Polygon"
                           ? nlohmann::json::array({geometry["coordinates"]})
                           : geometry["coordinates"];
    for (const auto& part : parts) {
      ASSERT_LT(polygon, drawn.owners.size());
      EXPECT_EQ(drawn.owners[polygon], i);
      ASSERT_EQ(part.size(), drawn.polygons.offsets[polygon + 1] - drawn.polygons.offsets[polygon]);
      for (std::size_t r = 0; r < part.size(); ++r) {
        const std::uint64_t ring = drawn.polygons.offsets[polygon] + r;
        const std::uint64_t begin = drawn.polygons.rows.offsets[ring];
        ASSERT_EQ(part[r].size(), drawn.polygons.rows.offsets[ring + 1] - begin);
        for (std::size_t k = 0; k < part[r].size(); ++k) {
          EXPECT_EQ(part[r][k][0].get<double>(), drawn.polygons.rows.values[begin + k].lon_deg);
          EXPECT_EQ(part[r][k][1].get<double>(), drawn.polygons.rows.values[begin + k].lat_deg);
        }
      }
      num_holes += part.size() - 1;
      ++polygon;
    }
  }
  EXPECT_EQ(polygon, drawn.owners.size());
  EXPECT_GT(num_holes, 0U);
  EXPECT_THROW(region_polygons(joined, 0), InvalidInput);
  EXPECT_TRUE(region_polygons({}).owners.empty());
}

TEST(overlay_written, pieces_cover_the_map_once) {
  const std::string path = temporary_path("pieces.geojson");
  const CellSet cells = CellSet::voronoi(triangulation_of("clustered", 500, 3));
  const CellSet others = CellSet::voronoi(triangulation_of("uniform", 100, 4));
  write_regions(path, intersection(cells, others).rings);
  EXPECT_NEAR(planar_sum(checked_rings(read_json(path), "pieces")), 360.0 * 180.0, 1e-6);
}

// All corners of a ring may be one point on the map, which has no lines then.
TEST(overlay_written, complements_of_tiny_cells_are_the_map) {
  const std::string path = temporary_path("tiny.geojson");
  CellRings cells;
  for (const Point& p : {Point{1, 0, 0}, Point{1, 4e-15, 0}, Point{1, 0, 4e-15}}) {
    cells.points.push_back(p);
  }
  cells.corners = {0, 1, 2, 2, 1, 0};
  cells.rings = {0, 3, 6};
  cells.cells = {0, 1, 2};
  write_regions(path, cells);
  const auto document = read_json(path);
  ASSERT_EQ(document["features"].size(), 2U);
  EXPECT_TRUE(document["features"][0]["geometry"].is_null());
  EXPECT_EQ(planar_sum(checked_rings(document, "tiny")), 360.0 * 180.0);
  const LonLatRegions drawn = region_polygons(cells);
  EXPECT_EQ(drawn.owners, std::vector<Index>{1});
}

TEST(overlay_written, properties_and_cells_without_rings) {
  const std::string path = temporary_path("properties.geojson");
  const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 30, 5));
  std::vector<Index> groups(30, no_index);
  groups[4] = 1;
  const CellRings joined = dissolve(cells.rings(), groups, 2);
  const Column names{"name", false, "ab\"c", {1, 4}};
  const Column numbers{"area", true, "12", {1, 2}};
  write_regions(path, joined, std::vector{names, numbers});
  const auto document = read_json(path);
  ASSERT_EQ(document["features"].size(), 1U);
  const auto& properties = document["features"][0]["properties"];
  EXPECT_EQ(properties["name"], "b\"c");
  EXPECT_EQ(properties["area_"], 2);
  EXPECT_NEAR(properties["area"].get<double>(), cells.areas()[4], 1e-15);
}

TEST(overlay_written, files_of_gdal_are_written_where_it_is_there) {
  const std::string path = temporary_path("regions.gpkg");
  const CellRings cells = CellSet::voronoi(triangulation_of("uniform", 10, 6)).rings();
  EXPECT_TRUE(can_write_regions(path));
  EXPECT_TRUE(can_write_regions({"regions", "fgb"}));
  EXPECT_FALSE(can_write_regions("regions.npy"));
  EXPECT_NO_THROW(require_region_writer("regions.geojson"));
  const auto error_of = [](const auto& work) {
    try {
      work();
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string missing = error_of([&] { require_region_writer(path); });
  EXPECT_EQ(error_of([&] { write_regions(path, cells); }), missing);
  EXPECT_TRUE(missing.empty() || missing.find("GDAL") != std::string::npos) << missing;
  EXPECT_EQ(std::filesystem::exists(path), missing.empty());
}

TEST(overlay_written, arrays_that_do_not_fit_are_refused) {
  const std::string path = temporary_path("refused.geojson");
  const CellRings cells = CellSet::voronoi(triangulation_of("uniform", 10, 6)).rings();
  EXPECT_THROW(write_regions(path, cells, std::vector{Column{"a", true, "1", {1}}}), InvalidInput);
  CellRings wrong = cells;
  wrong.corners[3] = static_cast<Index>(wrong.points.size());
  EXPECT_THROW(write_regions(path, wrong), InvalidInput);
  wrong = cells;
  wrong.cells.back() += 1;
  EXPECT_THROW(write_regions(path, wrong), InvalidInput);
  wrong = cells;
  wrong.points[0] = {0, 0, 2};
  EXPECT_THROW(write_regions(path, wrong), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
