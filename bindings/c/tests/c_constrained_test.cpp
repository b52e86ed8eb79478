// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Constrained triangulations in C are those of C++, and every failure is a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "rondel.h"
#include "rondel/constrained.h"

namespace rondel::test::of_c_constrained {
namespace {

using Ends = std::array<std::uint32_t, 2>;

struct FreeConstrained {
  void operator()(rondel_constrained* handle) const { rondel_constrained_free(handle); }
};
struct FreeFaces {
  void operator()(rondel_triangulation* handle) const { rondel_triangulation_free(handle); }
};
using Constrained = std::unique_ptr<rondel_constrained, FreeConstrained>;
using Faces = std::unique_ptr<rondel_triangulation, FreeFaces>;

// Unit vectors around the north pole, two of them in one place, and the south pole.
const std::vector<rondel::Point> points = {{0.6, 0, 0.8},  {0, 0.6, 0.8}, {-0.6, 0, 0.8},
                                           {0, -0.6, 0.8}, {0.6, 0, 0.8}, {0, 0, -1}};

rondel_status make(const std::vector<Ends>& constraints, std::int32_t crossings, Constrained& made,
                   const rondel_options* options = nullptr) {
  rondel_constrained* handle = nullptr;
  const rondel_status status = rondel_constrained_delaunay(
      &points.front().x, points.size(), constraints.empty() ? nullptr : constraints.front().data(),
      constraints.size(), options, crossings, nullptr, &handle);
  made.reset(handle);
  return status;
}

Faces faces_of(const rondel_constrained* constrained) {
  rondel_triangulation* handle = nullptr;
  EXPECT_EQ(rondel_constrained_triangulation(constrained, &handle), RONDEL_OK);
  return Faces(handle);
}

void expect_same(const rondel_constrained* made, const rondel::ConstrainedTriangulation& expected) {
  const Faces faces = faces_of(made);
  const rondel::Triangulation& t = expected.triangulation;
  ASSERT_EQ(rondel_num_sites(faces.get()), t.num_sites());
  ASSERT_EQ(rondel_num_faces(faces.get()), t.num_faces());
  EXPECT_TRUE(
      std::equal(t.faces().front().data(), t.faces().back().data() + 3, rondel_faces(faces.get())));
  EXPECT_TRUE(
      std::ranges::equal(expected.sides, std::span(rondel_constrained_sides(made), t.num_faces())));
  ASSERT_EQ(rondel_num_constrained_edges(made), expected.edges.size());
  const std::uint32_t* edges = rondel_constrained_edges(made);
  for (std::size_t e = 0; e < expected.edges.size(); ++e) {
    EXPECT_EQ((Ends{edges[2 * e], edges[2 * e + 1]}), expected.edges[e]);
  }
  EXPECT_TRUE(std::equal(expected.sources.offsets.begin(), expected.sources.offsets.end(),
                         rondel_constrained_source_offsets(made)));
  EXPECT_TRUE(std::equal(expected.sources.values.begin(), expected.sources.values.end(),
                         rondel_constrained_sources(made)));
}

TEST(c_constrained, triangulations_are_those_of_cpp) {
  for (const std::vector<Ends>& constraints :
       {std::vector<Ends>{}, {{1, 3}}, {{4, 2}, {2, 0}, {5, 1}}}) {
    Constrained made;
    ASSERT_EQ(make(constraints, RONDEL_REFUSE_CROSSINGS, made), RONDEL_OK);
    expect_same(made.get(), rondel::constrained_delaunay(points, constraints));
  }
}

TEST(c_constrained, crossings_are_errors_or_sites) {
  const std::vector<Ends> crossing = {{1, 3}, {5, 1}, {0, 2}};
  Constrained made;
  EXPECT_EQ(make(crossing, RONDEL_REFUSE_CROSSINGS, made), RONDEL_INVALID_INPUT);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(rondel_error_index(), 2U);
  EXPECT_EQ(std::string(rondel_error_message()).substr(0, 27), "constraints 0 and 2 cross a");
  ASSERT_EQ(make(crossing, RONDEL_SPLIT_CROSSINGS, made), RONDEL_OK);
  expect_same(made.get(), rondel::constrained_delaunay(
                              points, crossing, {.crossings = rondel::ConstraintCrossings::split}));
  const Faces faces = faces_of(made.get());
  EXPECT_EQ(rondel_num_sites(faces.get()), points.size() + 1);
}

TEST(c_constrained, cells_are_those_of_delaunay_faces) {
  Constrained made;
  ASSERT_EQ(make({{1, 3}}, RONDEL_REFUSE_CROSSINGS, made), RONDEL_OK);
  const Faces changed = faces_of(made.get());
  std::vector<double> numbers(3 * rondel_num_faces(changed.get()) + 3 * points.size());
  rondel_diagram* diagram = nullptr;
  rondel_locator* locator = nullptr;
  const bool is_changed = rondel_locator_create(changed.get(), &locator) != RONDEL_OK;
  rondel_locator_free(locator);
  ASSERT_EQ(make({{0, 2}}, RONDEL_REFUSE_CROSSINGS, made), RONDEL_OK);
  const Faces other = faces_of(made.get());
  // One of the two diagonals of the square around the pole is an edge of delaunay().
  const auto& [good, bad] = is_changed ? std::tie(other, changed) : std::tie(changed, other);
  EXPECT_EQ(rondel_areas(bad.get(), nullptr, numbers.data()), RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_centroids(bad.get(), nullptr, numbers.data()), RONDEL_INVALID_INPUT);
  EXPECT_EQ(rondel_diagram_create(bad.get(), nullptr, &diagram), RONDEL_INVALID_INPUT);
  EXPECT_EQ(diagram, nullptr);
  EXPECT_EQ(std::string(rondel_error_message()).substr(0, 29), "the arrays are not those of t");
  EXPECT_EQ(rondel_circumcenters(bad.get(), nullptr, numbers.data()), RONDEL_OK);
  EXPECT_EQ(rondel_areas(good.get(), nullptr, numbers.data()), RONDEL_OK);
  ASSERT_EQ(rondel_diagram_create(good.get(), nullptr, &diagram), RONDEL_OK);
  rondel_diagram_free(diagram);
}

TEST(c_constrained, wrong_calls_are_named) {
  Constrained made;
  EXPECT_EQ(make({{0, 1}, {0, 6}}, RONDEL_REFUSE_CROSSINGS, made), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "constraint 1 ends at site 6, but there are 6 sites");
  EXPECT_EQ(rondel_error_index(), 1U);
  EXPECT_EQ(make({{0, 1}}, 2, made), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "crossings: neither refused nor split");
  rondel_options options;
  rondel_options_init(&options);
  options.model = RONDEL_WEIGHTED;
  EXPECT_EQ(make({{0, 1}}, RONDEL_REFUSE_CROSSINGS, made, &options), RONDEL_INVALID_INPUT);
  EXPECT_STREQ(rondel_error_message(), "options: constraints are between projected sites");
  rondel_constrained* none = nullptr;
  EXPECT_EQ(rondel_constrained_delaunay(nullptr, 0, nullptr, 1, nullptr, 0, nullptr, &none),
            RONDEL_INVALID_INPUT);
  EXPECT_EQ(none, nullptr);
  rondel_triangulation* no_faces = nullptr;
  EXPECT_EQ(rondel_constrained_triangulation(nullptr, &no_faces), RONDEL_INVALID_INPUT);
  rondel_constrained_free(nullptr);
  ASSERT_EQ(rondel_constrained_delaunay(nullptr, 0, nullptr, 0, nullptr, 0, nullptr, &none),
            RONDEL_OK);
  EXPECT_EQ(rondel_num_constrained_edges(none), 0U);
  EXPECT_EQ(rondel_constrained_edges(none), nullptr);
  EXPECT_EQ(rondel_constrained_source_offsets(none)[0], 0U);
  rondel_constrained_free(none);
}

}  // namespace
}  // namespace rondel::test::of_c_constrained
