// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files of graphs, outlines and circles contain the right numbers, one by one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/graphs.h"
#include "rondel/outlines.h"
#include "support/generators.h"
#include "support/temporary_files.h"
#include "support/thrown.h"

namespace rondel::test {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(write_graph, npy_has_the_sites_as_integers_of_four_bytes) {
  const Triangulation t = delaunay(generator("uniform").make(70'000, 1).sites);
  const SiteGraph graph{{{3, 258}, {66'051, 2}}, {0.5, 0.25}};
  const std::string path = temporary_path("graph.npy");
  write_graph(path, t, graph);
  const std::string found = bytes_of(path);
  ASSERT_GE(found.size(), 16U);
  EXPECT_NE(found.find("(2, 2)"), std::string::npos);
  const std::array<unsigned char, 16> expected = {3, 0, 0, 0, 2, 1, 0, 0, 3, 2, 1, 0, 2, 0, 0, 0};
  EXPECT_EQ(found.substr(found.size() - 16), std::string(expected.begin(), expected.end()));
}

std::size_t index_of_refusal(const Triangulation& t, const SiteGraph& graph) {
  return thrown_index([&] { write_graph(temporary_path("bad.csv"), t, graph); });
}

TEST(write_graph, names_the_first_edge_that_is_wrong) {
  const Triangulation t = delaunay(generator("uniform").make(10, 1).sites);
  EXPECT_EQ(index_of_refusal(t, {{{0, 1}, {0, 2}, {1, 2}}, {1}}), 1U);
  EXPECT_EQ(index_of_refusal(t, {{{0, 1}}, {1, 2, 3}}), 1U);
  EXPECT_EQ(index_of_refusal(t, {{{0, 1}, {0, 10}}, {1, 1}}), 1U);
  EXPECT_EQ(index_of_refusal(t, {{{0, 1}, {10, 0}}, {1, 1}}), 1U);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(index_of_refusal(t, {{{0, 1}, {0, 2}}, {1, nan}}), 1U);
  EXPECT_EQ(index_of_refusal(t, {{{0, 9}}, {1}}), 99U);
}

// Two triangles far from each other, and a third that has a hole.
TEST(write_outline, counts_the_sites_of_each_polygon) {
  const Triangulation t = delaunay(generator("uniform").make(12, 1).sites);
  Outline outline;
  outline.rows.values = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  outline.rows.offsets = {0, 3, 7, 11};
  outline.offsets = {0, 1, 3};
  const std::string path = temporary_path("outline.geojson");
  write_outline(path, t, outline);
  const std::string text = bytes_of(path);
  EXPECT_NE(text.find(R"("sites":3})"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("sites":8})"), std::string::npos) << text;
}

TEST(write_outline, refuses_arrays_that_do_not_fit) {
  const Triangulation t = delaunay(generator("uniform").make(6, 1).sites);
  const auto is_refused = [&](const std::vector<std::uint64_t>& polygons,
                              const std::vector<std::uint64_t>& rings) {
    try {
      write_outline(temporary_path("bad.geojson"), t, {polygons, {rings, {0, 1, 2, 3, 4, 5}}});
    } catch (const InvalidInput&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(is_refused({0, 1, 2}, {0, 3, 6}));
  EXPECT_TRUE(is_refused({0, 1, 2}, {}));
  EXPECT_TRUE(is_refused({0, 1, 2}, {1, 3, 6}));
  EXPECT_TRUE(is_refused({0, 1, 2}, {0, 3, 5}));
  EXPECT_TRUE(is_refused({0, 1, 3}, {0, 4, 3, 6}));
  EXPECT_TRUE(is_refused({}, {0, 3, 6}));
  EXPECT_TRUE(is_refused({1, 2}, {0, 3, 6}));
  EXPECT_TRUE(is_refused({0, 1}, {0, 3, 6}));
}

TEST(write_circles, has_centers_on_the_antimeridian_at_its_western_end) {
  const std::vector<EmptyCircle> circles = {{{-1, 0, 0}, 0.5, {0, 1, 2}},
                                            {{0, 0, -1}, 0.25, {3, 4, 5}}};
  const std::string csv = temporary_path("circles.csv");
  write_circles(csv, circles);
  EXPECT_NE(bytes_of(csv).find("\n-180,0,28.647"), std::string::npos) << bytes_of(csv);
  EXPECT_NE(bytes_of(csv).find(",-90,14.323"), std::string::npos) << bytes_of(csv);
  const std::string json = temporary_path("circles.geojson");
  write_circles(json, circles);
  EXPECT_NE(bytes_of(json).find("[-180,0]"), std::string::npos) << bytes_of(json);
}

TEST(write_circles, refuses_centers_that_are_no_unit_vectors) {
  const auto is_refused = [](const Point& center, double radius) {
    const std::vector<EmptyCircle> circles = {{center, radius, {0, 1, 2}}};
    try {
      write_circles(temporary_path("bad.csv"), circles);
    } catch (const InvalidInput&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(is_refused({0, 0, std::sqrt(1 + 0.9e-6)}, 1));
  EXPECT_FALSE(is_refused({0, std::sqrt(1 - 0.9e-6), 0}, 1));
  EXPECT_TRUE(is_refused({0, 0, std::sqrt(1 + 1.1e-6)}, 1));
  EXPECT_TRUE(is_refused({std::sqrt(1 - 1.1e-6), 0, 0}, 1));
  EXPECT_TRUE(is_refused({1, 0, 0}, std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace rondel::test
