// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Twins against their definition, and subdivisions for any number of threads.
#include "overlay/twins.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "gtest/gtest.h"
#include "overlay/subdivision.h"
#include "rondel/cell_set.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "support/random.h"

namespace rondel {
namespace {

// For one halfedge after the other, the first one that leads back and has no twin yet.
std::vector<Index> twins_by_definition(std::span<const Index> rings,
                                       std::span<const Index> corners) {
  std::vector<Index> ends(corners.size());
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    for (Index h = rings[r]; h < rings[r + 1]; ++h)
      ends[h] = corners[h + 1 == rings[r + 1] ? rings[r] : h + 1];
  }
  std::vector<Index> twins(corners.size(), no_index);
  for (Index h = 0; h < corners.size(); ++h) {
    for (Index g = 0; g < corners.size() && twins[h] == no_index; ++g) {
      if (corners[g] != ends[h] || ends[g] != corners[h] || twins[g] != no_index) continue;
      twins[h] = g;
      twins[g] = h;
    }
  }
  return twins;
}

// Few points give edges that several rings have, and points with long rows.
TEST(overlay_twins, are_those_of_their_definition) {
  for (const std::uint64_t num_points : {2U, 4U, 9U, 60U, 500U}) {
    test::Random random(num_points);
    std::vector<Index> rings = {0};
    std::vector<Index> corners;
    while (corners.size() < 2000) {
      const std::uint64_t size = random.below(6);
      for (std::uint64_t k = 0; k < size; ++k) {
        // Every third one is in all rings, as a pole is.
        corners.push_back(k % 3 == 0 ? 0 : static_cast<Index>(random.below(num_points)));
      }
      rings.push_back(static_cast<Index>(corners.size()));
    }
    const std::vector<Index> expected = twins_by_definition(rings, corners);
    for (const unsigned threads : {1U, 2U, 7U}) {
      SCOPED_TRACE(testing::Message() << num_points << ' ' << threads);
      const auto twins = overlay::twins_of(rings, corners, num_points, threads);
      EXPECT_TRUE(std::ranges::equal(twins, expected));
    }
  }
}

TEST(overlay_twins, and_all_of_a_subdivision_do_not_depend_on_threads) {
  test::Random random(3);
  std::vector<Point> sites;
  for (int i = 0; i < 20000; ++i) sites.push_back(test::random_direction(random));
  const CellRings cells = CellSet::voronoi(delaunay(Sites::view(sites))).rings();
  const overlay::Subdivision one(cells, true, 1);
  EXPECT_TRUE(one.is_closed);
  EXPECT_GT(one.num_cells(), 4 * overlay::cells_per_task);
  for (const unsigned threads : {2U, 7U}) {
    SCOPED_TRACE(threads);
    const overlay::Subdivision other(cells, true, threads);
    EXPECT_EQ(other.points, one.points);
    EXPECT_EQ(other.cells, one.cells);
    EXPECT_EQ(other.rings, one.rings);
    EXPECT_EQ(other.given_starts, one.given_starts);
    EXPECT_EQ(other.begins, one.begins);
    EXPECT_EQ(other.corners, one.corners);
    EXPECT_EQ(other.twins, one.twins);
    EXPECT_EQ(other.cell_of, one.cell_of);
    EXPECT_EQ(other.shapes, one.shapes);
    EXPECT_EQ(other.centers, one.centers);
    EXPECT_EQ(other.names, one.names);
    EXPECT_EQ(other.keys, one.keys);
  }
}

}  // namespace
}  // namespace rondel
