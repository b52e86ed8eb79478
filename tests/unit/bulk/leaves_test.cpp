// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Leaves of divide and conquer, beside all triples and all other sites in integers.

#include "bulk/leaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace rondel::bulk {
namespace {

using Face = std::array<Index, 3>;  // counterclockwise, the least site first

struct Place {
  std::int64_t u;
  std::int64_t v;
  std::int64_t w;
};

Place operator-(const Place& a, const Place& b) { return {a.u - b.u, a.v - b.v, a.w - b.w}; }

std::int64_t turn(const Place& a, const Place& b, const Place& c) {
  const Place x = b - a;
  const Place y = c - a;
  return x.u * y.v - x.v * y.u;
}

// Positive if d is above the plane of a, b and c, which are counterclockwise.
std::int64_t volume(const Place& a, const Place& b, const Place& c, const Place& d) {
  const Place x = b - a;
  const Place y = c - a;
  const Place z = d - a;
  return x.u * (y.v * z.w - y.w * z.v) - x.v * (y.u * z.w - y.w * z.u) +
         x.w * (y.u * z.v - y.v * z.u);
}

using Leaf = std::vector<Place>;

// Whether three sites are on a line or four in a plane.
bool is_degenerate(const Leaf& leaf) {
  for (std::size_t a = 0; a < leaf.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t c = 0; c < b; ++c) {
        if (turn(leaf[a], leaf[b], leaf[c]) == 0) return true;
        for (std::size_t d = 0; d < c; ++d) {
          if (volume(leaf[a], leaf[b], leaf[c], leaf[d]) == 0) return true;
        }
      }
    }
  }
  return false;
}

std::set<Face> lower_faces(const Leaf& leaf) {
  std::set<Face> faces;
  const auto n = static_cast<Index>(leaf.size());
  for (Index a = 0; a < n; ++a) {
    for (Index b = a + 1; b < n; ++b) {
      for (Index c = a + 1; c < n; ++c) {
        if (b == c || turn(leaf[a], leaf[b], leaf[c]) <= 0) continue;
        const bool is_lowest = std::ranges::all_of(
            leaf, [&](const Place& d) { return volume(leaf[a], leaf[b], leaf[c], d) >= 0; });
        if (is_lowest) faces.insert({a, b, c});
      }
    }
  }
  return faces;
}

// Some are inside of the paraboloid and not below others, so that regular triangulations hide sites.
Leaf random_leaf(std::mt19937& random, std::size_t size, std::int64_t noise) {
  std::uniform_int_distribution<std::int64_t> place(-1000, 1000);
  std::uniform_int_distribution<std::int64_t> height(0, noise);
  for (;;) {
    Leaf leaf;
    for (std::size_t i = 0; i < size; ++i) {
      const std::int64_t u = place(random);
      const std::int64_t v = place(random);
      leaf.push_back({u, v, u * u + v * v + height(random)});
    }
    if (!is_degenerate(leaf)) return leaf;
  }
}

void set_lane(LeafGroup& group, std::size_t lane, const Leaf& leaf, double limit) {
  std::vector<SquarePoint> points;
  for (const Place& p : leaf) {
    points.push_back(
        {static_cast<double>(p.u), static_cast<double>(p.v), static_cast<double>(p.w), 1});
  }
  group.set(lane, points.data(), {limit, limit});
}

// The faces of a graph that has these sites, walked around one by one. Around a triangle the outer face
// has three edges, too, clockwise.
std::set<Face> faces_of(const PlaneGraph& graph, const Leaf& leaf, Index first) {
  std::set<Face> faces;
  for (PlaneGraph::Edge e = 0; e < graph.edge_limit(); ++e) {
    const PlaneGraph::Edge f = graph.face_next(e);
    const PlaneGraph::Edge g = graph.face_next(f);
    if (graph.face_next(g) != e) continue;
    Face face = {graph.origin(e) - first, graph.origin(f) - first, graph.origin(g) - first};
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    if (turn(leaf[face[0]], leaf[face[1]], leaf[face[2]]) > 0) faces.insert(face);
  }
  return faces;
}

class Graph {
 public:
  explicit Graph(std::size_t num_sites)
      : memory_((6 * num_sites + 2) * PlaneGraph::halfedge_bytes),
        graph_(memory_.data(), 6 * num_sites + 2, 0, num_sites) {}

  PlaneGraph& operator*() { return graph_; }

 private:
  std::vector<std::byte> memory_;
  PlaneGraph graph_;
};

// The corners of the boundary, counterclockwise.
std::vector<Index> boundary_of(const PlaneGraph& graph, Part part) {
  std::vector<Index> sites;
  const Index start = part.vertex;
  do {
    EXPECT_EQ(graph.origin(part.edge), part.vertex);
    sites.push_back(part.vertex);
    part = next_on_boundary(graph, part);
  } while (part.vertex != start && sites.size() <= max_leaf_sites);
  return sites;
}

void expect_convex(const Leaf& leaf, const std::vector<Index>& boundary, Index first) {
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Index a = boundary[i] - first;
    const Index b = boundary[(i + 1) % boundary.size()] - first;
    for (Index c = 0; c < leaf.size(); ++c) EXPECT_GE(turn(leaf[a], leaf[b], leaf[c]), 0);
  }
}

TEST(leaves, have_the_faces_that_all_triples_and_sites_tell) {
  std::mt19937 random(7);
  for (std::size_t size = 3; size <= max_leaf_sites; ++size) {
    for (const std::int64_t noise : {0, 1'000'000}) {
      std::vector<Leaf> leaves;
      LeafGroup group;
      group.num_sites = size;
      for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
        leaves.push_back(random_leaf(random, size, noise));
        set_lane(group, lane, leaves.back(), 0);
      }
      find_leaf_faces(group);
      for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
        ASSERT_NE(group.certain[lane], 0U);
        constexpr Index first = 5;
        Graph graph(first + size);
        const Part part = draw_leaf(*graph, group, lane, first);
        EXPECT_EQ(faces_of(*graph, leaves[lane], first), lower_faces(leaves[lane])) << size;
        expect_convex(leaves[lane], boundary_of(*graph, part), first);
      }
    }
  }
}

TEST(leaves, are_not_certain_where_a_filter_is_not) {
  std::mt19937 random(8);
  LeafGroup group;
  group.num_sites = 4;
  const Leaf in_a_plane = {{0, 0, 0}, {8, 0, 64}, {0, 8, 64}, {8, 8, 128}};
  const Leaf on_a_line = {{0, 0, 0}, {3, 3, 18}, {7, 7, 98}, {9, 1, 82}};
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    set_lane(group, lane, random_leaf(random, 4, 0), 0.5);
  }
  set_lane(group, 1, in_a_plane, 0.5);
  set_lane(group, 4, on_a_line, 0.5);
  set_lane(group, 6, random_leaf(random, 4, 0), 1e300);
  find_leaf_faces(group);
  for (std::size_t lane = 0; lane < num_leaf_lanes; ++lane) {
    EXPECT_EQ(group.certain[lane] == 0, lane == 1 || lane == 4 || lane == 6) << lane;
  }
}

}  // namespace
}  // namespace rondel::bulk
