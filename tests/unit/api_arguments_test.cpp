// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays that callers bring, and that may be anything: an answer or InvalidInput.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"
#include "support/generators.h"

namespace rondel {
namespace {

// Areas and centroids of cells in which one number is another one.
TEST(cells, of_a_caller_are_those_of_the_triangulation_or_refused) {
  const std::vector<Point> sites = test::generator("uniform").make(60, 1).sites;
  const Triangulation t = delaunay(sites);
  const Cells right = cells(t, sites);
  const auto refused = [&](const Cells& wrong) {
    EXPECT_THROW(areas(t, sites, wrong), InvalidInput);
    EXPECT_THROW(centroids(t, sites, wrong), InvalidInput);
  };
  EXPECT_EQ(areas(t, sites, right).size(), sites.size());
  refused({});
  Cells wrong = right;
  for (std::uint64_t& offset : wrong.offsets) {
    const std::uint64_t before = offset;
    for (const std::uint64_t other : {before + 1, before - 1, std::uint64_t{1} << 40}) {
      offset = other;
      refused(wrong);
    }
    offset = before;
  }
  for (Index& position : wrong.rings) {
    const Index before = position;
    for (const Index other : {(before + 1) % static_cast<Index>(t.num_faces()), no_index}) {
      position = other;
      refused(wrong);
    }
    position = before;
  }
  std::swap(wrong.rings[0], wrong.rings[1]);
  refused(wrong);
  wrong = right;
  wrong.points.resize(t.num_faces() - 1);
  refused(wrong);
}

TEST(writers, refuse_what_does_not_belong_together) {
  const std::string path = testing::TempDir() + "rondel_arguments";
  SiteTable table;
  table.sites = test::generator("uniform").make(30, 1).sites;
  const std::vector<Point> sites(table.sites.begin(), table.sites.end());
  const Triangulation t = delaunay(sites);
  const Diagram right = diagram(t, sites);
  const auto refused = [&](const Diagram& wrong) {
    for (const char* ending : {".geojson", ".vtp", ".npz"}) {
      EXPECT_THROW(write_cells(path + ending, table, t, wrong), InvalidInput);
      EXPECT_FALSE(std::filesystem::exists(path + ending));
    }
  };
  refused({});
  Diagram wrong = right;
  wrong.areas.pop_back();
  refused(wrong);
  wrong = right;
  wrong.cells.rings[5] = no_index;
  refused(wrong);
  wrong = right;
  wrong.cells.offsets[3] = 1000;
  refused(wrong);
  wrong = right;
  wrong.cells.points.clear();
  refused(wrong);
  const Triangulation fewer = delaunay(std::span(sites).first(20));
  for (const char* ending : {".off", ".ply", ".obj", ".stl", ".vtp", ".geojson", ".npy"}) {
    EXPECT_THROW(write_triangles(path + ending, table, fewer), InvalidInput);
  }
}

}  // namespace
}  // namespace rondel
