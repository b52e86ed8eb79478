// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What constrained_delaunay() refuses, and how check_constrained() names what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "rondel/cell_set.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/dynamic.h"
#include "rondel/graphs.h"
#include "rondel/interpolate.h"
#include "rondel/mesh.h"
#include "rondel/outlines.h"
#include "rondel/query.h"
#include "support/thrown.h"

namespace rondel::test::of_constrained_errors {
namespace {

using Ends = std::array<Index, 2>;

// A square around the north pole, whose diagonals cross there, and the south pole.
const std::vector<Point> square = {{1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {0, -1, 1}, {0, 0, -1}};

std::string message_of(const std::vector<Point>& sites, const std::vector<Ends>& constraints) {
  return thrown_message<InvalidInput>([&] { return constrained_delaunay(sites, constraints); });
}

TEST(constrained_errors, constraints_without_an_arc_are_named) {
  EXPECT_EQ(message_of(square, {{0, 1}, {1, 5}}),
            "constraint 1 ends at site 5, but there are 5 sites");
  EXPECT_EQ(message_of(square, {{3, 3}}), "constraint 0 begins and ends at site 3");
  std::vector<Point> sites = square;
  sites.push_back({2, 0, 2});
  EXPECT_EQ(message_of(sites, {{0, 5}}),
            "constraint 0 joins sites 0 and 5, which are in one place");
  sites.push_back({0, 0, 3});
  EXPECT_EQ(message_of(sites, {{4, 6}}),
            "constraint 0 joins sites 4 and 6, which are opposite to each other");
  EXPECT_EQ(thrown_index([&] {
              return constrained_delaunay(square, std::vector<Ends>{{0, 1}, {2, 2}});
            }),
            1U);
  sites[1].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(thrown_index([&] {
              return constrained_delaunay(sites, std::vector<Ends>{{9, 9}});
            }),
            1U);
}

TEST(constrained_errors, crossing_constraints_are_named_with_their_place) {
  const std::vector<Point> sites = {{1, 0, 1}, {1, 1, 1}, {1, 0, 0.5}, {1, 1, 0.5}, {-1, 0, -0.5}};
  const std::vector<Ends> constraints = {{4, 0}, {1, 2}, {0, 3}};
  try {
    static_cast<void>(constrained_delaunay(sites, constraints));
    FAIL() << "nothing was thrown";
  } catch (const CrossingConstraints& error) {
    EXPECT_EQ(error.constraints(), (Ends{1, 2}));
    EXPECT_EQ(error.index(), 2U);
    EXPECT_NEAR(error.place().lon_deg, 26.56505117707799, 1e-12);
    EXPECT_NEAR(error.place().lat_deg, 33.854498, 1e-3);
    EXPECT_EQ(std::string(error.what()).substr(0, 44),
              "constraints 1 and 2 cross at longitude 26.56");
  }
  EXPECT_THROW(constrained_delaunay(square, std::vector<Ends>{{0, 2}, {1, 3}}),
               CrossingConstraints);
}

TEST(constrained_errors, split_needs_unit_vectors) {
  ConstrainedOptions options{.crossings = ConstraintCrossings::split};
  const std::vector<Ends> constraints = {{0, 1}};
  EXPECT_THROW(constrained_delaunay(square, constraints, options), InvalidInput);
  options.sphere.center = {1, 0, 0};
  EXPECT_EQ(thrown_message<InvalidInput>(
                [&] { return constrained_delaunay(square, constraints, options); }),
            "crossings of constraints are split around the origin only");
}

// Of a square around a pole the diagonal that the Delaunay triangulation does not have.
Ends other_diagonal(const std::vector<Point>& sites) {
  const Triangulation triangulation = delaunay(sites);
  for (const Triple& face : triangulation.faces()) {
    if (std::ranges::find(face, 4U) == face.end()) {
      for (const Ends& ends : {Ends{0, 2}, Ends{1, 3}}) {
        if (std::ranges::find(face, ends[0]) == face.end() ||
            std::ranges::find(face, ends[1]) == face.end()) {
          return ends;
        }
      }
    }
  }
  return {};
}

TEST(constrained_errors, what_relies_on_delaunay_faces_refuses_others) {
  const std::vector<Ends> other = {other_diagonal(square)};
  const ConstrainedTriangulation changed = constrained_delaunay(square, other);
  EXPECT_THROW(Locator{changed.triangulation}, InvalidInput);
  EXPECT_THROW(DynamicTriangulation{changed.triangulation}, InvalidInput);
  EXPECT_THROW(Interpolator{changed.triangulation}, InvalidInput);
  EXPECT_THROW(cells(changed.triangulation), InvalidInput);
  EXPECT_THROW(areas(changed.triangulation), InvalidInput);
  EXPECT_THROW(diagram(changed.triangulation), InvalidInput);
  EXPECT_THROW(centroids(changed.triangulation), InvalidInput);
  EXPECT_THROW(CellSet::voronoi(changed.triangulation), InvalidInput);
  EXPECT_THROW(site_graph(changed.triangulation, GraphKind::gabriel), InvalidInput);
  EXPECT_THROW(alpha_shape(changed.triangulation, 1), InvalidInput);
  EXPECT_THROW(largest_empty_circles(changed.triangulation, 1), InvalidInput);
  EXPECT_THROW(mesh::make_mesh(changed.triangulation), InvalidInput);
  EXPECT_EQ(circumcenters(changed.triangulation).size(), changed.triangulation.num_faces());
  const ConstrainedTriangulation same = constrained_delaunay(square, std::vector<Ends>{{0, 1}});
  EXPECT_EQ(Locator(same.triangulation).nearest(Point{1, 0.1, 1}), 0U);
  EXPECT_EQ(areas(same.triangulation), areas(delaunay(square)));
}

TEST(constrained_errors, the_check_names_what_is_wrong) {
  const std::vector<Ends> other = {other_diagonal(square)};
  const ConstrainedTriangulation changed = constrained_delaunay(square, other);
  const auto faces = changed.triangulation.faces();
  const auto reason = [&](std::span<const Ends> constraints, std::vector<Triple> triangles) {
    return check_constrained(square, constraints, triangles).reason;
  };
  const std::vector<Triple> all(faces.begin(), faces.end());
  EXPECT_EQ(reason(other, all), "");
  EXPECT_NE(reason({}, all).find("is neither constrained nor locally Delaunay"), std::string::npos);
  const Triangulation unconstrained = delaunay(square);
  const std::vector<Triple> given(unconstrained.faces().begin(), unconstrained.faces().end());
  EXPECT_NE(reason(other, given).find("constraint 0 is no chain of edges"), std::string::npos);
  std::vector<Triple> fewer = all;
  fewer.pop_back();
  EXPECT_NE(reason(other, fewer).find("has a face on one side only"), std::string::npos);
  std::vector<Triple> twice = all;
  twice.push_back(all[0]);
  EXPECT_NE(reason(other, twice).find("are on one side of edge"), std::string::npos);
  std::vector<Triple> turned = all;
  std::swap(turned[0][0], turned[0][1]);
  EXPECT_NE(reason(other, turned).find("not solid"), std::string::npos);
  turned = all;
  turned[2][1] = 9;
  EXPECT_EQ(reason(other, turned), "face 2 has corner 9, but there are 5 sites");
}

}  // namespace
}  // namespace rondel::test::of_constrained_errors
