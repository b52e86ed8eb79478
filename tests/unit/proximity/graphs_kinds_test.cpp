// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Graphs against their definitions over all pairs and triples of vertices, in integers of GMP.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/error.h"
#include "rondel/graphs.h"
#include "support/generators.h"
#include "support/oracle.h"
#include "support/root_sum.h"

namespace rondel::test {
namespace {

using Edge = std::array<Index, 2>;
using Edges = std::vector<Edge>;

class DistanceOracle {
 public:
  explicit DistanceOracle(const Triangulation& t)
      : points_(t.sites().points().begin(), t.sites().points().end()),
        oracle_(points_, Model::projected, t.sphere()) {
    std::vector<bool> is_vertex(t.num_sites(), true);
    for (const Duplicate& d : t.duplicates()) is_vertex[d.site] = false;
    for (Index i = 0; i < t.num_sites(); ++i) {
      if (is_vertex[i]) vertices_.push_back(i);
    }
  }

  [[nodiscard]] const std::vector<Index>& vertices() const { return vertices_; }

  // The sign of |ab| - |cd|.
  [[nodiscard]] int compare(const Edge& ab, const Edge& cd) const {
    RootSum sum;
    sum.squares = {product(ab[0], ab[0]), product(ab[1], ab[1]), product(cd[0], cd[0]),
                   product(cd[1], cd[1])};
    sum.c[0b0011] = product(cd[0], cd[1]);
    sum.c[0b1100] = -product(ab[0], ab[1]);
    return sign(sum);
  }

  [[nodiscard]] bool is_in_cap(Index a, Index b, Index c) const {
    RootSum sum;
    sum.squares = {product(a, a), product(b, b), product(c, c), 1};
    sum.c[0b0010] = product(c, a);
    sum.c[0b0001] = product(c, b);
    sum.c[0b0100] = -product(a, b);
    sum.c[0b0111] = -1;
    return sign(sum) >= 0;
  }

  [[nodiscard]] bool is_nearer_to_both(const Edge& edge, Index c) const {
    return c != edge[0] && c != edge[1] && compare({edge[0], c}, edge) < 0 &&
           compare({edge[1], c}, edge) < 0;
  }

 private:
  [[nodiscard]] mpz_class product(Index a, Index b) const {
    return dot(oracle_.vector(a), oracle_.vector(b));
  }

  std::vector<Point> points_;
  Oracle oracle_;
  std::vector<Index> vertices_;
};

Edges all_pairs(const DistanceOracle& oracle) {
  Edges pairs;
  for (const Index a : oracle.vertices()) {
    for (const Index b : oracle.vertices()) {
      if (a < b) pairs.push_back({a, b});
    }
  }
  return pairs;
}

Edges gabriel_pairs(const DistanceOracle& oracle) {
  Edges found = all_pairs(oracle);
  std::erase_if(found, [&](const Edge& e) {
    return std::ranges::any_of(oracle.vertices(), [&](Index c) {
      return c != e[0] && c != e[1] && oracle.is_in_cap(e[0], e[1], c);
    });
  });
  return found;
}

Edges relative_pairs(const DistanceOracle& oracle) {
  Edges found = all_pairs(oracle);
  std::erase_if(found, [&](const Edge& e) {
    return std::ranges::any_of(oracle.vertices(),
                               [&](Index c) { return oracle.is_nearer_to_both(e, c); });
  });
  return found;
}

Edges tree_of_pairs(const DistanceOracle& oracle) {
  Edges pairs = all_pairs(oracle);
  std::ranges::stable_sort(pairs,
                           [&](const Edge& e, const Edge& f) { return oracle.compare(e, f) < 0; });
  std::map<Index, Index> component;
  for (const Index v : oracle.vertices()) component[v] = v;
  Edges tree;
  for (const Edge& e : pairs) {
    const Index old = component[e[0]];
    const Index now = component[e[1]];
    if (old == now) continue;
    tree.push_back(e);
    for (auto& [v, c] : component) {
      if (c == old) c = now;
    }
  }
  std::ranges::sort(tree);
  return tree;
}

Edges solid_edges(const Triangulation& t) {
  std::set<Edge> found;
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (t.is_ghost(f)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t.faces()[f][i];
      const Index b = t.faces()[f][(i + 1) % 3];
      found.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return {found.begin(), found.end()};
}

Edges urquhart_edges(const Triangulation& t, const DistanceOracle& oracle) {
  Edges found = solid_edges(t);
  std::erase_if(found, [&](const Edge& e) {
    for (Index f = 0; f < t.num_faces(); ++f) {
      const Triple& face = t.faces()[f];
      const bool has_edge = std::ranges::count(face, e[0]) + std::ranges::count(face, e[1]) == 2;
      if (!has_edge || t.is_ghost(f)) continue;
      if (std::ranges::any_of(face, [&](Index c) { return oracle.is_nearer_to_both(e, c); })) {
        return true;
      }
    }
    return false;
  });
  return found;
}

Edges edges_of(const Triangulation& t, GraphKind kind) { return site_graph(t, kind).edges; }

template <class Visit>
void for_each_small_case(const Visit& visit) {
  for (const Generator& generator : generators()) {
    if (generator.weighted_only || generator.has_long_integers) continue;
    for (const std::size_t n : {1U, 2U, 3U, 5U, 9U, 22U}) {
      SCOPED_TRACE(std::string(generator.name) + " " + std::to_string(n));
      const SiteSet set = generator.make(n, 3);
      visit(delaunay(set.sites, {.sphere = set.sphere}));
    }
  }
}

TEST(graphs, are_those_of_all_pairs_for_every_generator) {
  for_each_small_case([](const Triangulation& t) {
    const DistanceOracle oracle(t);
    EXPECT_EQ(edges_of(t, GraphKind::gabriel), gabriel_pairs(oracle));
    EXPECT_EQ(edges_of(t, GraphKind::relative), relative_pairs(oracle));
    EXPECT_EQ(edges_of(t, GraphKind::spanning_tree), tree_of_pairs(oracle));
    if (t.dimension() == 2) {
      EXPECT_EQ(edges_of(t, GraphKind::delaunay), solid_edges(t));
      EXPECT_EQ(edges_of(t, GraphKind::urquhart), urquhart_edges(t, oracle));
    }
  });
}

TEST(graphs, are_part_of_each_other) {
  for_each_small_case([](const Triangulation& t) {
    const Edges delaunay_edges = edges_of(t, GraphKind::delaunay);
    const Edges gabriel = edges_of(t, GraphKind::gabriel);
    const Edges urquhart = edges_of(t, GraphKind::urquhart);
    const Edges relative = edges_of(t, GraphKind::relative);
    const Edges tree = edges_of(t, GraphKind::spanning_tree);
    EXPECT_TRUE(std::ranges::includes(edges(t), delaunay_edges));
    EXPECT_TRUE(std::ranges::includes(delaunay_edges, gabriel));
    EXPECT_TRUE(std::ranges::includes(delaunay_edges, urquhart));
    EXPECT_TRUE(std::ranges::includes(gabriel, relative));
    EXPECT_TRUE(std::ranges::includes(urquhart, relative));
    EXPECT_TRUE(std::ranges::includes(relative, tree));
    EXPECT_EQ(tree.size() + 1, t.num_vertices());
  });
}

TEST(graphs, of_an_octahedron_keep_ties) {
  const std::vector<Point> sites = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                    {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const Triangulation t = delaunay(sites);
  EXPECT_EQ(edges_of(t, GraphKind::delaunay).size(), 12U);
  EXPECT_EQ(edges_of(t, GraphKind::urquhart).size(), 12U);
  EXPECT_EQ(edges_of(t, GraphKind::relative).size(), 12U);
  EXPECT_EQ(edges_of(t, GraphKind::gabriel).size(), 12U);
  EXPECT_EQ(edges_of(t, GraphKind::spanning_tree), (Edges{{0, 1}, {0, 2}, {0, 4}, {0, 5}, {1, 3}}));
  EXPECT_NEAR(site_graph(t, GraphKind::gabriel).lengths[0], 1.5707963267948966, 3e-16);
}

TEST(graphs, have_none_or_one_edge_for_few_sites) {
  EXPECT_TRUE(edges_of(Triangulation(), GraphKind::gabriel).empty());
  EXPECT_TRUE(
      edges_of(delaunay(std::vector<Point>{{1, 0, 0}, {2, 0, 0}}), GraphKind::delaunay).empty());
  const Triangulation antipodes = delaunay(std::vector<Point>{{1, 0, 0}, {-1, 0, 0}, {2, 0, 0}});
  for (const GraphKind kind : {GraphKind::delaunay, GraphKind::urquhart, GraphKind::gabriel,
                               GraphKind::relative, GraphKind::spanning_tree}) {
    EXPECT_EQ(edges_of(antipodes, kind), (Edges{{0, 1}}));
    EXPECT_NEAR(site_graph(antipodes, kind).lengths[0], 3.141592653589793, 5e-16);
  }
}

TEST(graphs, are_the_same_for_any_number_of_threads) {
  const SiteSet set = generator("uniform").make(6000, 7);
  const Triangulation t = delaunay(set.sites);
  for (const GraphKind kind : {GraphKind::relative, GraphKind::spanning_tree}) {
    const SiteGraph one = site_graph(t, kind, {.threads = 1});
    const SiteGraph four = site_graph(t, kind, {.threads = 4});
    EXPECT_EQ(one.edges, four.edges);
    EXPECT_EQ(one.lengths, four.lengths);
  }
}

TEST(graphs, of_weighted_sites_are_refused) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  EXPECT_THROW((void)site_graph(delaunay(sites, {.model = Model::weighted}), GraphKind::gabriel),
               InvalidInput);
}

TEST(graphs, have_an_edge_index_in_one_or_both_directions) {
  const SiteGraph graph{{{0, 2}, {1, 2}}, {0.5, 0.25}};
  const EdgeIndex both = edge_index(graph);
  EXPECT_EQ(both.ends, (std::vector<std::int64_t>{0, 1, 2, 2, 2, 2, 0, 1}));
  EXPECT_EQ(both.lengths, (std::vector<double>{0.5, 0.25, 0.5, 0.25}));
  const EdgeIndex one = edge_index(graph, EdgeDirections::one);
  EXPECT_EQ(one.ends, (std::vector<std::int64_t>{0, 1, 2, 2}));
  EXPECT_EQ(one.lengths, graph.lengths);
}

}  // namespace
}  // namespace rondel::test
