// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The data structure of divide and conquer: a graph drawn without crossings, without coordinates.
// It also holds what a triangulation cannot: single edges, chains, an outer face.
//
//            c         Halfedges come in pairs e, e^1. Those that leave one vertex form a ring:
//           / \        next(e) is the one counterclockwise after e, previous(e) the one before.
//   next(e)/   \       The face to the left of e runs on with face_next(e), and the outer face
//         /  f  \      lies to the left of the halfedges that have it there, too.
//        a---e---b
//
// (Guibas and Stolfi, ACM Trans. Graph. 4, 1985, without the dual graph.)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "rondel/types.h"
#include "system/huge_pages.h"

namespace rondel::bulk {

class PlaneGraph {
 public:
  using Edge = Index;  // a halfedge

  struct alignas(16) Links {
    Edge next;
    Edge previous;
    Index target;
    Index face;
  };

  // Forgets all edges.
  void clear(std::size_t max_vertices) {
    // Deleted pairs are used again, and a plane graph has less than three edges a vertex.
    if (capacity_ < max_vertices) {
      const std::size_t size = 6 * max_vertices + 1;
      edges_.reset();
      edges_ = std::make_unique_for_overwrite<Links[]>(size);
      system::advise_huge_pages(edges_.get(), size * sizeof(Links));
      capacity_ = max_vertices;
    }
    limit_ = 0;
    free_ = 0;
    edges_[0].next = 2;
  }

  // For loops: the same links without a look at this object for each.
  [[nodiscard]] const Links* links() const { return edges_.get(); }
  [[nodiscard]] Links* links() { return edges_.get(); }

  [[nodiscard]] Edge next(Edge e) const { return edges_[e].next; }
  [[nodiscard]] Edge previous(Edge e) const { return edges_[e].previous; }
  [[nodiscard]] Index target(Edge e) const { return edges_[e].target; }
  [[nodiscard]] Index origin(Edge e) const { return edges_[e ^ 1].target; }
  [[nodiscard]] Edge face_next(Edge e) const { return edges_[e ^ 1].previous; }

  // What the user wants to remember of the face on the left; no_index of a new halfedge.
  [[nodiscard]] Index face(Edge e) const { return edges_[e].face; }
  void set_face(Edge e, Index face) { edges_[e].face = face; }

  // Halfedges are below this; those of deleted pairs have no target.
  [[nodiscard]] Edge edge_limit() const { return limit_; }
  [[nodiscard]] bool is_alive(Edge e) const { return edges_[e].target != no_index; }

  // Whether there are as many edges as a plane graph can have, so that no more may be added.
  [[nodiscard]] bool is_full() const { return limit_ == 6 * capacity_; }

  // Pairs without ends and rings.
  template <std::size_t N>
  std::array<Edge, N> new_pairs() {
    std::array<Edge, N> pairs;
    for (Edge& e : pairs) e = new_pair();
    return pairs;
  }

  struct Spoke {
    Edge edge;
    Index target;
  };
  // All halfedges of a vertex, counterclockwise.
  template <std::size_t N>
  void set_ring(const std::array<Spoke, N>& ring) {
    for (std::size_t i = 0; i < N; ++i) {
      edges_[ring[i].edge] = {ring[(i + 1) % N].edge, ring[(i + N - 1) % N].edge, ring[i].target,
                              no_index};
    }
  }

  // A new pair from a to b, each alone in its ring. Returns the halfedge from a.
  Edge add(Index a, Index b) {
    const Edge e = new_pair();
    set_ring<1>({{{e, b}}});
    set_ring<1>({{{e ^ 1, a}}});
    return e;
  }

  // A new pair from a to b, counterclockwise after f around a and after g around b.
  Edge add(Index a, Index b, Edge f, Edge g) {
    const Edge e = new_pair();
    const Edge after_f = edges_[f].next;
    const Edge after_g = edges_[g].next;
    edges_[e] = {after_f, f, b, no_index};
    edges_[e ^ 1] = {after_g, g, a, no_index};
    edges_[f].next = e;
    edges_[after_f].previous = e;
    edges_[g].next = e ^ 1;
    edges_[after_g].previous = e ^ 1;
    return e;
  }

  // Puts e, alone in its ring, into the ring of f counterclockwise after f.
  void insert_after(Edge e, Edge f) {
    const Edge g = edges_[f].next;
    edges_[e].previous = f;
    edges_[e].next = g;
    edges_[f].next = e;
    edges_[g].previous = e;
  }

  // Takes the pair of e out of both rings.
  void remove(Edge e) {
    unlink(e);
    unlink(e ^ 1);
    edges_[e].target = no_index;
    edges_[e ^ 1].target = no_index;
    edges_[e & ~Edge{1}].next = free_;
    free_ = e & ~Edge{1};
  }

 private:
  // The list of deleted pairs runs on with those never used, which saves a branch that would depend
  // on the input: the first of these is always ready.
  Edge new_pair() {
    const Edge e = std::exchange(free_, edges_[free_].next);
    limit_ = std::max(limit_, e + 2);
    edges_[limit_].next = limit_ + 2;
    return e;
  }

  void unlink(Edge e) {
    const Links& links = edges_[e];
    edges_[links.previous].next = links.next;
    edges_[links.next].previous = links.previous;
  }

  std::unique_ptr<Links[]> edges_;  // not initialized
  std::size_t capacity_ = 0;        // in vertices
  Edge limit_ = 0;
  Edge free_ = 0;  // at most limit_
};

}  // namespace rondel::bulk
