// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of regions as GeoJSON, read back.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "overlay_support.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "unit/geojson_rings.h"

namespace rondel::test {
namespace {

double planar_sum(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& ring : rings) sum += planar_area(ring);
  return sum;
}

TEST(overlay_written, groups_cover_the_map_once) {
  const std::string path = testing::TempDir() + "rondel_groups.geojson";
  for (const std::size_t n : {8U, 50U, 2000U}) {
    const Partition cells = Partition::voronoi(triangulation_of("uniform", n, 3));
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

TEST(overlay_written, pieces_cover_the_map_once) {
  const std::string path = testing::TempDir() + "rondel_pieces.geojson";
  const Partition cells = Partition::voronoi(triangulation_of("clustered", 500, 3));
  const Partition others = Partition::voronoi(triangulation_of("uniform", 100, 4));
  write_regions(path, intersection(cells, others).rings);
  EXPECT_NEAR(planar_sum(checked_rings(read_json(path), "pieces")), 360.0 * 180.0, 1e-6);
}

TEST(overlay_written, properties_and_cells_without_rings) {
  const std::string path = testing::TempDir() + "rondel_properties.geojson";
  const Partition cells = Partition::voronoi(triangulation_of("uniform", 30, 5));
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

TEST(overlay_written, arrays_that_do_not_fit_are_refused) {
  const std::string path = testing::TempDir() + "rondel_refused.geojson";
  const CellRings cells = Partition::voronoi(triangulation_of("uniform", 10, 6)).rings();
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
