// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Large hulls, each proved by exact arithmetic in linear time.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "rondel/hull.h"
#include "support/generators.h"
#include "support/hull_check.h"

namespace rondel::test {
namespace {

class solid_hulls : public testing::TestWithParam<Cloud> {};
class flat_hulls : public testing::TestWithParam<Cloud> {};

std::string name_of(const testing::TestParamInfo<Cloud>& cloud) {
  return std::string(cloud.param.name);
}

TEST_P(solid_hulls, are_exact) {
  const std::vector<Point> points = GetParam().make(scaled(100000), 1);
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 2);
  EXPECT_EQ(hull_error(hull, points), "");
  EXPECT_EQ(hull.num_ghost_faces(), 0U);
}

TEST_P(flat_hulls, are_exact) {
  const std::vector<Point> points = GetParam().make(scaled(3000), 1);
  const Triangulation hull = convex_hull(points);
  EXPECT_EQ(hull.dimension(), 1);
  EXPECT_EQ(hull_error(hull, points), "");
}

// Everything but the names of the sites, which change with the order: sites by coordinates.
struct Shape {
  Point center;
  std::vector<Point> corners;
  std::vector<Triple> neighbors;
  std::vector<Point> ring;
  std::set<std::pair<std::array<double, 3>, Index>> hidden;
  std::size_t num_duplicates;
  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const std::vector<Point>& points) {
  const Triangulation hull = convex_hull(points);
  Shape shape;
  shape.center = hull.sphere().center;
  for (const Triple& face : hull.faces()) {
    for (const Index corner : face) shape.corners.push_back(points[corner]);
  }
  shape.neighbors.assign(hull.neighbors().begin(), hull.neighbors().end());
  for (const Index corner : hull.ring()) shape.ring.push_back(points[corner]);
  if (shape.ring.size() == 2 && shape.ring[1].x < shape.ring[0].x) {
    std::swap(shape.ring[0], shape.ring[1]);  // a line's ends come in the order of input
  }
  for (const Hidden& h : hull.hidden()) {
    const Point& p = points[h.site];
    shape.hidden.insert({{p.x, p.y, p.z}, h.face});
  }
  shape.num_duplicates = hull.duplicates().size();
  return shape;
}

void expect_any_order(std::vector<Point> points) {
  const Shape first = shape_of(points);
  Random(3).shuffle(points);
  const bool is_equal = shape_of(points) == first;
  EXPECT_TRUE(is_equal);
}

TEST_P(solid_hulls, do_not_depend_on_the_order) { expect_any_order(GetParam().make(20000, 2)); }
TEST_P(flat_hulls, do_not_depend_on_the_order) { expect_any_order(GetParam().make(2000, 2)); }

INSTANTIATE_TEST_SUITE_P(clouds, solid_hulls,
                         testing::ValuesIn(solid_clouds().begin(), solid_clouds().end()), name_of);
INSTANTIATE_TEST_SUITE_P(clouds, flat_hulls,
                         testing::ValuesIn(flat_clouds().begin(), flat_clouds().end()), name_of);

}  // namespace
}  // namespace rondel::test
