// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts of an arrangement: boxes, places of crossings, contacts, chains.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/crossing_place.h"
#include "arrangement/snapped_chain.h"
#include "exact/vector.h"
#include "rondel/arrangement.h"

namespace rondel::test::of_steps {
namespace {

using arrangement::BoxTree;
using arrangement::SpaceBox;

TEST(box_tree, finds_all_pairs_that_overlap) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> coordinate(0, 1);
  for (const std::size_t count : {0U, 1U, 2U, 8U, 9U, 65U, 300U}) {
    std::vector<SpaceBox> boxes(count);
    for (SpaceBox& box : boxes) {
      for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = coordinate(random);
        box.high[i] = box.low[i] + 0.2 * coordinate(random);
      }
    }
    std::vector<std::pair<Index, Index>> expected;
    for (Index i = 0; i < count; ++i) {
      for (Index k = i + 1; k < count; ++k) {
        if (boxes[i].overlaps(boxes[k])) expected.emplace_back(i, k);
      }
    }
    const BoxTree tree(boxes, 1);
    std::vector<std::pair<Index, Index>> found;
    for (std::size_t block = 0; block < tree.num_blocks(); ++block) {
      tree.visit_pairs(block, [&](Index i, Index k) { found.emplace_back(i, k); });
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << count;
    for (Index i = 0; i < count; ++i) {
      std::vector<Index> near;
      tree.visit(boxes[i], [&](Index k) { near.push_back(k); });
      std::ranges::sort(near);
      std::vector<Index> expected_near;
      for (Index k = 0; k < count; ++k) {
        if (boxes[i].overlaps(boxes[k])) expected_near.push_back(k);
      }
      EXPECT_EQ(near, expected_near);
    }
  }
}

// A vector of numbers with 4,000 bits.
class Exact {
 public:
  Exact() {
    for (auto& x : x_) mpfr_init2(x, 4000);
  }
  explicit Exact(const Point& p) : Exact() {
    mpfr_set_d(x_[0], p.x, MPFR_RNDN);
    mpfr_set_d(x_[1], p.y, MPFR_RNDN);
    mpfr_set_d(x_[2], p.z, MPFR_RNDN);
  }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  ~Exact() {
    for (auto& x : x_) mpfr_clear(x);
  }

  void set_cross(const Exact& a, const Exact& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      mpfr_fmms(x_[i], a.x_[(i + 1) % 3], b.x_[(i + 2) % 3], a.x_[(i + 2) % 3], b.x_[(i + 1) % 3],
                MPFR_RNDN);
    }
  }
  // Returns the nearest doubles of the unit vector.
  Point unit() {
    mpfr_t sum;
    mpfr_init2(sum, 4000);
    mpfr_set_ui(sum, 0, MPFR_RNDN);
    for (auto& x : x_) mpfr_fma(sum, x, x, sum, MPFR_RNDN);
    mpfr_sqrt(sum, sum, MPFR_RNDN);
    for (auto& x : x_) mpfr_div(x, x, sum, MPFR_RNDN);
    mpfr_clear(sum);
    return {mpfr_get_d(x_[0], MPFR_RNDN), mpfr_get_d(x_[1], MPFR_RNDN),
            mpfr_get_d(x_[2], MPFR_RNDN)};
  }

 private:
  std::array<mpfr_t, 3> x_;
};

Point exact_place(const Point& a, const Point& b, const Point& c, const Point& d) {
  Exact first;
  Exact second;
  Exact line;
  first.set_cross(Exact(a), Exact(b));
  second.set_cross(Exact(c), Exact(d));
  line.set_cross(first, second);
  const Point place = line.unit();
  return dot(place, a + b) < 0 ? -1.0 * place : place;
}

TEST(crossing_place, is_the_nearest_double) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<> number(-1, 1);
  const auto vector = [&] { return Point{number(random), number(random), number(random)}; };
  for (int trial = 0; trial < 3000; ++trial) {
    // Arcs of all sizes, at angles of all sizes, some of them in coordinate planes.
    const double size = std::ldexp(1, -(trial % 40));
    const double angle = std::ldexp(1, -(trial / 40 % 40));
    Point middle = vector();
    Point along = vector();
    if (trial % 3 == 0) middle.z = along.z = 0;
    middle = normalized(middle);
    const Point across = vector();
    const Point a = normalized(middle + size * along);
    const Point b = normalized(middle - size * along);
    const Point c = normalized(middle + size * (along + angle * across));
    const Point d = normalized(middle - size * (along + angle * across));
    if (norm(cross(cross(a, b - a), cross(c, d - c))) == 0) continue;
    EXPECT_EQ(arrangement::crossing_place(a, b, c, d), exact_place(a, b, c, d)) << trial;
    EXPECT_EQ(arrangement::crossing_place(d, c, a, b), exact_place(a, b, c, d)) << trial;
  }
}

TEST(is_near, holds_within_the_radius_of_the_inside) {
  const Point a = {1, 0, 0};
  const Point b = {0, 1, 0};
  const auto at = [](double angle, double height) {
    return Point{std::cos(angle), std::sin(angle), height};
  };
  constexpr double r = arrangement_radius;
  EXPECT_TRUE(arrangement::is_near(a, b, at(0.7, 0)));
  EXPECT_TRUE(arrangement::is_near(a, b, at(0.7, 0.99 * r)));
  EXPECT_TRUE(arrangement::is_near(a, b, at(0.7, -0.99 * r)));
  EXPECT_FALSE(arrangement::is_near(a, b, at(0.7, 1.01 * r)));
  EXPECT_FALSE(arrangement::is_near(a, b, at(-1e-15, 0)));
  EXPECT_TRUE(arrangement::is_near(a, b, at(1e-15, 0)));
  EXPECT_FALSE(arrangement::is_near(a, b, at(2, 0)));
  EXPECT_FALSE(arrangement::is_near(a, b, at(0.7 + 3.14159, 0)));
}

// Nodes at x along the equator and y above it, in units of the radius.
std::vector<Index> chain_through(const std::vector<std::pair<double, double>>& places,
                                 bool& is_crowded) {
  std::vector<Point> nodes = {{1, 0, 0}, normalized(Point{1, 0.5, 0})};
  std::vector<Index> near;
  for (const auto& [x, y] : places) {
    constexpr double r = arrangement_radius;
    near.push_back(static_cast<Index>(nodes.size()));
    nodes.push_back({1, 0.25 + 64 * r * x, r * y});
  }
  std::vector<Index> chain;
  is_crowded = arrangement::append_nearest_nodes(nodes, {0, 1}, near, {}, chain);
  return chain;
}

TEST(append_nearest_nodes, takes_nodes_whose_cells_the_arc_enters) {
  bool is_crowded = false;
  EXPECT_EQ(chain_through({}, is_crowded), (std::vector<Index>{}));
  EXPECT_EQ(chain_through({{1, 0.5}, {0, -0.5}}, is_crowded), (std::vector<Index>{3, 2}));
  EXPECT_FALSE(is_crowded);
  // The arc takes the nearest of nodes above each other.
  EXPECT_EQ(chain_through({{0, 0.5}, {0, 0.25}, {0, -0.75}}, is_crowded), (std::vector<Index>{3}));
  EXPECT_TRUE(is_crowded);
  // Two nodes a quarter of a radius apart: both are the nearest ones somewhere.
  EXPECT_EQ(chain_through({{0, 0}, {1. / 256, 0.125}}, is_crowded), (std::vector<Index>{2, 3}));
  EXPECT_TRUE(is_crowded);
}

TEST(append_nodes_on_arc, sorts_them) {
  const std::vector<Point> nodes = {{0, 1, 0}, {1, 0, 0}, {0.6, 0.8, 0}, {0.8, 0.6, 0}};
  std::vector<Index> chain;
  arrangement::append_nodes_on_arc(nodes, {1, 0}, std::vector<Index>{2, 3}, chain);
  EXPECT_EQ(chain, (std::vector<Index>{3, 2}));
  chain.clear();
  arrangement::append_nodes_on_arc(nodes, {0, 1}, std::vector<Index>{3, 2}, chain);
  EXPECT_EQ(chain, (std::vector<Index>{2, 3}));
}

}  // namespace
}  // namespace rondel::test::of_steps
