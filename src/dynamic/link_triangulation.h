// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What fills the hole when a vertex v leaves: the faces of the hull of its neighbors that v was
// above.
//
// The neighbors, in their order around v, form a polygon, the link. It is triangulated by
// Chew's algorithm (Building Voronoi diagrams for convex polygons in linear expected time,
// Dartmouth 1990; for deletions Devillers, SoCG 1999): take the corners off in random order until
// three are left, then put them back in reverse. A corner u comes back between its neighbors a and
// b:
//
//          x --- b              if u is in conflict with the face at the edge (a, b), the conflict
//         / \   / \             region is a tree of faces behind that edge, without an inner
//        /   \ /   u            vertex; it is replaced by a fan at u. Otherwise the face (u, b, a)
//       y --- a --'             is added.
//
// docs/theory/removal.md proves that the perturbed conflict test may be asked here.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::dynamic {

class LinkTriangulation {
 public:
  // `link` has at least three vertices, counterclockwise seen from outside. The test is a
  // kernel::ConflictTest, or what has its is_in_conflict(face, vertex). The vertices of a convex
  // polygon are as good as a link, for the faces of their Delaunay triangulation.
  template <class Test>
  void run(Test& test, std::span<const Index> link) {
    const auto size = static_cast<Index>(link.size());
    close_ring(size);
    shuffle(size);
    for (Index i = 0; i + 3 < size; ++i) take_off(order_[i]);
    start(order_[size - 3]);
    for (Index i = size - 3; i-- > 0;) put_back(test, link, order_[i]);
  }
  // Does the same for a polygon that need not be convex, but whose corners that are convex are ears, also
  // when others have been taken off, except for positions 0 and 1: only these corners are taken off.
  // is_convex(p, u, q) says whether the corner u is, by positions, if its neighbors are p and q.
  // Returns false if there are not enough of them; faces() is invalid then.
  template <class Test, class IsConvex>
  bool run_by_ears(Test& test, std::span<const Index> link, const IsConvex& is_convex) {
    const auto size = static_cast<Index>(link.size());
    close_ring(size);
    if (!take_ears_off(size, is_convex)) return false;
    start(0);
    for (Index i = size - 3; i-- > 0;) put_back(test, link, order_[i]);
    return true;
  }

  // Vertices are positions in the link. An edge of the polygon has no opposite.
  [[nodiscard]] std::span<const topology::Face> faces() const { return faces_; }

 private:
  void close_ring(Index size) {
    order_.resize(size);
    next_.resize(size);
    previous_.resize(size);
    inner_.resize(size);
    for (Index i = 0; i < size; ++i) {
      order_[i] = i;
      next_[i] = i + 1 < size ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : size - 1;
    }
  }

  void shuffle(Index size) {
    for (Index i = size; i > 3; --i) std::swap(order_[size - i], order_[size - i + below(i)]);
  }

  // Returns a number below another one, by Knuth's linear congruential generator.
  Index below(Index limit) {
    random_ = random_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<Index>((random_ >> 33) % limit);
  }

  void take_off(Index u) {
    next_[previous_[u]] = next_[u];
    previous_[next_[u]] = previous_[u];
  }

  // Takes convex corners off in random order, until three are left. One that is convex stays so when a
  // neighbor goes.
  template <class IsConvex>
  bool take_ears_off(Index size, const IsConvex& is_convex) {
    ears_.clear();
    is_ear_.assign(size, false);
    const auto look_at = [&](Index u) {
      if (u < 2 || is_ear_[u] || !is_convex(previous_[u], u, next_[u])) return;
      is_ear_[u] = true;
      ears_.push_back(u);
    };
    for (Index u = 2; u < size; ++u) look_at(u);
    for (Index i = 0; i + 3 < size; ++i) {
      if (ears_.empty()) return false;
      std::swap(ears_[below(static_cast<Index>(ears_.size()))], ears_.back());
      const Index u = ears_.back();
      ears_.pop_back();
      order_[i] = u;
      take_off(u);
      look_at(previous_[u]);
      look_at(next_[u]);
    }
    return true;
  }

  void start(Index a) {
    const Index b = next_[a];
    const Index c = next_[b];
    faces_.assign(1, {{a, b, c}, {no_index, no_index, no_index}});
    inner_[b] = topology::halfedge(0, 0);
    inner_[c] = topology::halfedge(0, 1);
    inner_[a] = topology::halfedge(0, 2);
  }

  template <class Test>
  void put_back(Test& test, std::span<const Index> link, Index u) {
    const Index a = previous_[u];
    const Index b = next_[u];
    find_conflict_region(test, link, u, {b, inner_[a]});
    fan(u, a);
    next_[a] = u;
    previous_[b] = u;
  }

  // Finds the conflict region as kernel/conflict_region.h does, entering through one edge of the
  // polygon.
  template <class Test>
  void find_conflict_region(Test& test, std::span<const Index> link, Index u,
                            topology::HorizonEdge entry) {
    region_.clear();
    horizon_.clear();
    stack_.assign(1, entry);
    while (!stack_.empty()) {
      const topology::HorizonEdge edge = stack_.back();
      stack_.pop_back();
      if (edge.outside == no_index || !is_in_conflict(test, link, u, edge.outside)) {
        horizon_.push_back(edge);
        continue;
      }
      const Index f = topology::face_of(edge.outside);
      const unsigned entered = topology::edge_of(edge.outside);
      const unsigned next = topology::next_corner[entered];
      const unsigned previous = topology::previous_corner[entered];
      region_.push_back(f);
      // Edge i begins at corner i+1.
      stack_.push_back({faces_[f].vertex[entered], faces_[f].opposite[previous]});
      stack_.push_back({faces_[f].vertex[previous], faces_[f].opposite[next]});
    }
  }

  template <class Test>
  [[nodiscard]] bool is_in_conflict(Test& test, std::span<const Index> link, Index u,
                                    topology::Halfedge h) const {
    const auto& v = faces_[topology::face_of(h)].vertex;
    return test.is_in_conflict({link[v[0]], link[v[1]], link[v[2]]}, link[u]);
  }

  // One face (u, s, t) for each edge s -> t of the horizon, which ends at `last`.
  void fan(Index u, Index last) {
    const std::size_t size = horizon_.size();
    while (region_.size() < size) {
      region_.push_back(static_cast<Index>(faces_.size()));
      faces_.emplace_back();
    }
    for (std::size_t i = 0; i < size; ++i) {
      const auto& [origin, outside] = horizon_[i];
      const Index f = region_[i];
      const bool is_last = i + 1 == size;
      const topology::Halfedge next = is_last ? no_index : topology::halfedge(region_[i + 1], 2);
      const topology::Halfedge before = i == 0 ? no_index : topology::halfedge(region_[i - 1], 1);
      faces_[f] = {{u, origin, is_last ? last : horizon_[i + 1].origin}, {outside, next, before}};
      if (outside == no_index) {
        inner_[origin] = topology::halfedge(f, 0);
      } else {
        faces_[topology::face_of(outside)].opposite[topology::edge_of(outside)] =
            topology::halfedge(f, 0);
      }
    }
    inner_[u] = topology::halfedge(region_.front(), 2);
    inner_[last] = topology::halfedge(region_[size - 1], 1);
  }

  std::vector<topology::Face> faces_;
  std::vector<Index> order_;
  std::vector<Index> next_;
  std::vector<Index> previous_;
  std::vector<topology::Halfedge> inner_;  // for each edge of the polygon, by its first corner
  std::vector<Index> ears_;
  std::vector<bool> is_ear_;  // also of those that have been taken off
  std::vector<Index> region_;
  std::vector<topology::HorizonEdge> horizon_;
  std::vector<topology::HorizonEdge> stack_;
  std::uint64_t random_ = 1;
};

}  // namespace rondel::dynamic
