// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The numbered promises of arrange(), on hostile sets of arcs. Exact signs are those of integers
// by GMP, which share no code with the library.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "exact/vector.h"
#include "rondel/arrangement.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "support/thrown.h"
#include "unit/arrangement/arc_sets.h"

namespace rondel::test::of_arrange {
namespace {

using Ends = std::array<Index, 2>;
using Integers = std::array<mpz_class, 3>;

// Returns the coordinates times 2^1074, which are integers.
Integers integers_of(const Point& p) {
  const auto integer = [](double x) {
    mpf_class scaled(x, 64);
    mpf_mul_2exp(scaled.get_mpf_t(), scaled.get_mpf_t(), 1074);
    return mpz_class(scaled);
  };
  return {integer(p.x), integer(p.y), integer(p.z)};
}

Integers normal_of(const Integers& a, const Integers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpz_class product(const Integers& a, const Integers& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// An arc with exact coordinates.
struct ExactArc {
  Integers from;
  Integers to;
  Integers normal;

  ExactArc(const Integers& a, const Integers& b) : from(a), to(b), normal(normal_of(a, b)) {}
  // True if a point, which is no end, lies in the inside of the arc.
  [[nodiscard]] bool contains(const Integers& p) const {
    return product(normal, p) == 0 && is_between(p);
  }
  // True if a point on the great circle lies in the inside of the arc.
  [[nodiscard]] bool is_between(const Integers& p) const {
    return product(normal_of(from, p), normal) > 0 && product(normal_of(p, to), normal) > 0;
  }
  // Returns the distance of a unit vector from the plane of the arc.
  [[nodiscard]] double distance(const Integers& p) const {
    const mpf_class unit_length(product(normal, normal) * product(p, p), 256);
    const mpf_class height(abs(product(normal, p)), 256);
    return mpf_class(height / sqrt(unit_length)).get_d();
  }
  [[nodiscard]] bool crosses(const ExactArc& other) const {
    Integers line = normal_of(normal, other.normal);
    if (line[0] == 0 && line[1] == 0 && line[2] == 0) return false;
    if (is_between(line) && other.is_between(line)) return true;
    for (mpz_class& x : line) x = -x;
    return is_between(line) && other.is_between(line);
  }
};

// Checks promise 1.
void expect_planar(const Arrangement& result) {
  std::vector<Integers> nodes;
  for (const Point& p : result.nodes) nodes.push_back(integers_of(p));
  std::vector<ExactArc> edges;
  for (const auto& [a, b] : result.edges) edges.emplace_back(nodes[a], nodes[b]);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = result.edges[i];
    ASSERT_LT(a, b);
    for (std::size_t k = i + 1; k < edges.size(); ++k) ASSERT_FALSE(edges[i].crosses(edges[k]));
    for (Index node = 0; node < nodes.size(); ++node) {
      ASSERT_TRUE(node == a || node == b || !edges[i].contains(nodes[node]));
    }
  }
  ASSERT_TRUE(std::ranges::is_sorted(result.edges));
  ASSERT_TRUE(std::ranges::adjacent_find(result.edges) == result.edges.end());
}

// Checks that each chain leads from end to end, promise 2, and how far its nodes are from the arc.
void expect_chains(const ArcSet& set, const Arrangement& result) {
  // Twice, because arcs may be bent twice, and once more for rounding here.
  constexpr double reach = 3 * arrangement_radius;
  ASSERT_EQ(result.chains.size(), set.arcs.size());
  for (std::size_t i = 0; i < set.arcs.size(); ++i) {
    const Point& from = set.points[set.arcs[i][0]];
    const Point& to = set.points[set.arcs[i][1]];
    const auto is_node_of = [&](Index node, const Point& p) {
      return norm(cross(result.nodes[node], p)) < 1e-15;
    };
    const std::span<const Index> chain = result.chains[i];
    if (chain.empty()) continue;
    Index at = result.edges[chain.front() / 2][chain.front() % 2];
    ASSERT_TRUE(is_node_of(at, from));
    const ExactArc arc(integers_of(from), integers_of(to));
    for (const Index h : chain) {
      ASSERT_EQ(result.edges[h / 2][h % 2], at);
      at = result.edges[h / 2][1 - h % 2];
      ASSERT_LT(arc.distance(integers_of(result.nodes[at])), reach);
    }
    ASSERT_TRUE(is_node_of(at, to));
  }
  for (const Ends& ends : set.arcs) {
    for (const Index p : ends) {
      ASSERT_TRUE(std::ranges::any_of(
          result.nodes, [&](const Point& node) { return norm(node - set.points[p]) < 1e-14; }));
    }
  }
}

class ArrangedSets : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(arrange, ArrangedSets, testing::ValuesIn(kinds_of_arc_sets()),
                         [](const auto& kind) { return kind.param; });

TEST_P(ArrangedSets, keep_the_promises) {
  const std::size_t count = scaled(60);
  std::mt19937_64 random(5);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ArcSet set = arc_set(GetParam(), 2 + seed % 13, seed);
    const Arrangement result = arrange(set.points, set.arcs, {1});
    expect_planar(result);
    expect_chains(set, result);

    // Promise 4: the order and direction of arcs and the threads change nothing.
    std::vector<Ends> shuffled = set.arcs;
    std::ranges::shuffle(shuffled, random);
    for (Ends& ends : shuffled) {
      if (random() % 2 == 0) std::swap(ends[0], ends[1]);
    }
    const Arrangement other = arrange(set.points, shuffled, {2});
    ASSERT_EQ(other.nodes, result.nodes);
    ASSERT_EQ(other.edges, result.edges);

    // The arrangement of the edges, and of the nodes that have none, is itself.
    std::vector<Ends> arcs = result.edges;
    for (Index node = 0; node < result.nodes.size(); ++node) arcs.push_back({node, node});
    const Arrangement again = arrange(result.nodes, arcs, {1});
    ASSERT_EQ(again.nodes, result.nodes);
    ASSERT_EQ(again.edges, result.edges);
    if (HasFatalFailure()) return;
  }
}

TEST(arrange, two_arcs_that_cross_have_five_nodes) {
  const std::vector<Point> points = {
      {1, 0, 0}, {0, 1, 0}, normalized(Point{1, 1, 1}), normalized(Point{1, 1, -1})};
  const Arrangement result = arrange(points, std::vector<Ends>{{0, 1}, {3, 2}});
  EXPECT_EQ(result.nodes.size(), 5U);
  EXPECT_EQ(result.edges.size(), 4U);
  EXPECT_EQ(result.chains[0].size(), 2U);
  EXPECT_EQ(result.chains[1].size(), 2U);
  // The crossing is at 45 degrees of the equator, exactly on it.
  const Index h = result.chains[0][0];
  const Point crossing = result.nodes[result.edges[h / 2][1 - h % 2]];
  EXPECT_EQ(crossing, (Point{std::sqrt(0.5), std::sqrt(0.5), 0}));
}

TEST(arrange, arcs_that_overlap_share_their_edges) {
  const std::vector<Point> points = {{1, 0, 0}, {0, 1, 0}, {-0.6, 0.8, 0}, {0.8, 0.6, 0}};
  const Arrangement result = arrange(points, std::vector<Ends>{{0, 1}, {2, 3}, {3, 3}});
  EXPECT_EQ(result.edges.size(), 3U);
  EXPECT_EQ(result.chains[0].size(), 2U);
  EXPECT_EQ(result.chains[1].size(), 2U);
  EXPECT_EQ(result.chains[2].size(), 0U);
  EXPECT_EQ(result.chains[0][1] ^ 1U, result.chains[1][1]);
}

TEST(arrange, an_arc_is_divided_by_a_point_on_it) {
  const std::vector<Point> points = {{1, 0, 0}, {0, 1, 0}, {0.6, 0.8, 0}};
  const Arrangement result = arrange(points, std::vector<Ends>{{0, 1}, {2, 2}});
  EXPECT_EQ(result.nodes.size(), 3U);
  EXPECT_EQ(result.edges.size(), 2U);
}

TEST(arrange, nothing_has_no_nodes) {
  const Arrangement result = arrange({}, {});
  EXPECT_TRUE(result.nodes.empty());
  EXPECT_TRUE(result.edges.empty());
  EXPECT_EQ(result.chains.size(), 0U);
}

TEST(arrange, what_is_no_arc_is_refused) {
  const std::vector<Point> points = {{1, 0, 0}, {-1, 0, 0}, {0, 0.5, 0}, {1, 1e-60, 0}};
  const std::span<const Point> poles = std::span(points).first(2);
  const auto index_of = [](std::span<const Point> given, const std::vector<Ends>& arcs) {
    return thrown_index([&] { arrange(given, arcs); });
  };
  EXPECT_EQ(index_of(poles, {{0, 0}, {0, 1}}), 1U);
  EXPECT_EQ(index_of(poles, {{0, 2}}), 0U);
  EXPECT_EQ(index_of(std::span(points).first(3), {}), 2U);
  EXPECT_EQ(index_of(std::vector{points[0], points[3]}, {}), 1U);
}

}  // namespace
}  // namespace rondel::test::of_arrange
