// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Halfedges and Coverage, on a figure that is small enough to draw:
//
//     3 ------- 2
//     |      /  |
//     |   /     |
//     0 ------- 1 ----- 4
#include "arrangement/halfedges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "arrangement/coverage.h"
#include "exact/vector.h"
#include "rondel/arrangement.h"

namespace rondel::test::of_halfedges {
namespace {

using arrangement::Coverage;
using arrangement::EdgeOfPolygon;
using arrangement::Halfedges;
using arrangement::Owners;

const std::vector<std::array<double, 2>> places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
const std::vector<std::array<Index, 2>> sides = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 4}};

Point at(double x, double y) { return normalized(Point{1, 0.1 * x, 0.1 * y}); }

class Figure : public testing::Test {
 protected:
  Figure() {
    std::vector<Point> points;
    for (const auto& [x, y] : places) points.push_back(at(x, y));
    arranged_ = arrange(points, sides, {1});
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const Index h = arranged_.chains[k][0];
      halfedges_[{sides[k][0], sides[k][1]}] = h;
      halfedges_[{sides[k][1], sides[k][0]}] = h ^ 1U;
    }
    for (Index node = 0; node < places.size(); ++node) {
      const auto found = std::ranges::find(arranged_.nodes, points[node]);
      nodes_.push_back(static_cast<Index>(found - arranged_.nodes.begin()));
    }
  }
  // Returns the halfedge from one place to another.
  [[nodiscard]] Index from_to(Index from, Index to) const { return halfedges_.at({from, to}); }

  Arrangement arranged_;
  std::map<std::array<Index, 2>, Index> halfedges_;
  std::vector<Index> nodes_;
};

TEST_F(Figure, halfedges_follow_each_other_around_faces) {
  const Halfedges halfedges(arranged_, 1);
  EXPECT_EQ(halfedges.next(from_to(0, 1)), from_to(1, 2));
  EXPECT_EQ(halfedges.next(from_to(1, 2)), from_to(2, 0));
  EXPECT_EQ(halfedges.next(from_to(2, 0)), from_to(0, 1));
  EXPECT_EQ(halfedges.next(from_to(0, 2)), from_to(2, 3));
  // Around the outer face, clockwise, with the spike from 1 to 4.
  EXPECT_EQ(halfedges.next(from_to(2, 1)), from_to(1, 4));
  EXPECT_EQ(halfedges.next(from_to(1, 4)), from_to(4, 1));
  EXPECT_EQ(halfedges.next(from_to(4, 1)), from_to(1, 0));
  EXPECT_EQ(halfedges.around(nodes_[1]).size(), 3U);
}

TEST_F(Figure, sectors_are_to_the_right_of_a_path) {
  const Halfedges halfedges(arranged_, 1);
  EXPECT_EQ(halfedges.sector_towards(nodes_[0], at(2, 1)), from_to(0, 1));
  EXPECT_EQ(halfedges.sector_towards(nodes_[0], at(1, 2)), from_to(0, 2));
  EXPECT_EQ(halfedges.sector_towards(nodes_[0], at(-1, 0.5)), from_to(0, 3));
  // Along an edge: to its right at the start, which is its left seen from the end.
  EXPECT_EQ(halfedges.sector_towards(nodes_[0], at(1, 1)), from_to(0, 1));
  EXPECT_EQ(halfedges.sector_from(nodes_[2], at(0, 0)), from_to(2, 0));
  EXPECT_EQ(halfedges.sector_from(nodes_[0], at(1, 1)), from_to(0, 2));
}

TEST_F(Figure, paths_pass_nodes_to_their_right) {
  const Halfedges halfedges(arranged_, 1);
  const auto is_crossed = [&](Index from, Index to, const Point& p, const Point& q) {
    return halfedges.is_crossed(from_to(from, to) / 2, p, q);
  };
  EXPECT_TRUE(is_crossed(0, 2, at(0.2, 0.9), at(0.9, 0.1)));
  EXPECT_FALSE(is_crossed(0, 1, at(0.2, 0.9), at(0.9, 0.1)));
  EXPECT_FALSE(is_crossed(0, 2, -1.0 * at(0.2, 0.9), -1.0 * at(0.9, 0.1)));
}

// The triangle 0 1 2 is polygon 0, the square polygon 1, of the other operand.
TEST_F(Figure, faces_have_the_polygons_around_them) {
  const Halfedges halfedges(arranged_, 1);
  std::vector<std::vector<EdgeOfPolygon>> rows(arranged_.edges.size());
  const auto add = [&](Index from, Index to, Index polygon) {
    const Index h = from_to(from, to);
    rows[h / 2].push_back({polygon, h % 2 == 0 ? 1 : -1});
  };
  for (const auto& [from, to] : {std::array<Index, 2>{0, 1}, {1, 2}, {2, 0}}) add(from, to, 0);
  for (const auto& [from, to] : {std::array<Index, 2>{0, 1}, {1, 2}, {2, 3}, {3, 0}}) {
    add(from, to, 1);
  }
  CompressedRows<EdgeOfPolygon> polygons;
  for (const auto& row : rows) polygons.append(row);
  std::map<Index, Owners> found;
  const std::vector<std::uint8_t> operands = {0, 1};
  Coverage(halfedges, polygons, operands, {}, {}, 1).visit([&](Index h, const Owners& owners) {
    found[h] = owners;
  });
  EXPECT_EQ(found.size(), halfedges.size());
  EXPECT_EQ(found[from_to(0, 1)], (Owners{{{0}, {1}}}));
  EXPECT_EQ(found[from_to(0, 2)], (Owners{{{}, {1}}}));
  EXPECT_EQ(found[from_to(1, 0)], (Owners{}));
  EXPECT_EQ(found[from_to(1, 4)], (Owners{}));
}

}  // namespace
}  // namespace rondel::test::of_halfedges
