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

  // Two arrays with elements of eight bytes, which machines address by their index.
  struct Ring {
    Edge next;
    Edge previous;
  };
  struct End {
    Index target;
    Index face;
  };

  // Forgets all edges.
  void clear(std::size_t max_vertices) {
    // Deleted pairs are used again, and a plane graph has less than three edges a vertex.
    if (capacity_ < max_vertices) {
      const std::size_t size = 6 * max_vertices + 1;
      rings_.reset();
      rings_ = std::make_unique_for_overwrite<Ring[]>(size);
      system::advise_huge_pages(rings_.get(), size * sizeof(Ring));
      ends_.reset();
      ends_ = std::make_unique_for_overwrite<End[]>(size);
      system::advise_huge_pages(ends_.get(), size * sizeof(End));
      capacity_ = max_vertices;
    }
    full_ = 6 * capacity_;
    limit_ = 0;
    free_ = 0;
    rings_[0].next = 2;
  }

  // For loops: the same arrays without a look at this object for each element.
  [[nodiscard]] const Ring* rings() const { return rings_.get(); }
  [[nodiscard]] End* ends() { return ends_.get(); }

  [[nodiscard]] Edge next(Edge e) const { return rings_[e].next; }
  [[nodiscard]] Edge previous(Edge e) const { return rings_[e].previous; }
  [[nodiscard]] Index target(Edge e) const { return ends_[e].target; }
  [[nodiscard]] Index origin(Edge e) const { return ends_[e ^ 1].target; }
  [[nodiscard]] Edge face_next(Edge e) const { return rings_[e ^ 1].previous; }

  // What the user wants to remember of the face on the left; no_index of a new halfedge.
  [[nodiscard]] Index face(Edge e) const { return ends_[e].face; }
  void set_face(Edge e, Index face) { ends_[e].face = face; }

  // Halfedges are below this; those of deleted pairs have no target.
  [[nodiscard]] Edge edge_limit() const { return static_cast<Edge>(limit_); }
  [[nodiscard]] bool is_alive(Edge e) const { return ends_[e].target != no_index; }

  // Whether there are as many edges as a plane graph can have, so that no more may be added.
  [[nodiscard]] bool is_full() const { return limit_ == full_; }

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
      rings_[ring[i].edge] = {ring[(i + 1) % N].edge, ring[(i + N - 1) % N].edge};
      ends_[ring[i].edge] = {ring[i].target, no_index};
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
    const Edge after_f = rings_[f].next;
    const Edge after_g = rings_[g].next;
    rings_[e] = {after_f, f};
    rings_[e + 1] = {after_g, g};
    ends_[e] = {b, no_index};
    ends_[e + 1] = {a, no_index};
    rings_[f].next = e;
    rings_[after_f].previous = e;
    rings_[g].next = e + 1;
    rings_[after_g].previous = e + 1;
    return e;
  }

  // Puts e, alone in its ring, into the ring of f counterclockwise after f.
  void insert_after(Edge e, Edge f) {
    const Edge g = rings_[f].next;
    rings_[e].previous = f;
    rings_[e].next = g;
    rings_[f].next = e;
    rings_[g].previous = e;
  }

  // Takes the pair of e out of both rings.
  void remove(Edge e) {
    unlink(e);
    unlink(e ^ 1);
    ends_[e].target = no_index;
    ends_[e ^ 1].target = no_index;
    rings_[e & ~Edge{1}].next = static_cast<Edge>(free_);
    free_ = e & ~Edge{1};
  }

 private:
  // The list of deleted pairs runs on with those never used, which saves a branch that would depend
  // on the input: the first of these is always ready.
  Edge new_pair() {
    const std::size_t e = std::exchange(free_, rings_[free_].next);
    limit_ = std::max(limit_, e + 2);
    rings_[limit_].next = static_cast<Edge>(limit_ + 2);
    return static_cast<Edge>(e);
  }

  void unlink(Edge e) {
    const Ring links = rings_[e];
    rings_[links.previous].next = links.next;
    rings_[links.next].previous = links.previous;
  }

  std::unique_ptr<Ring[]> rings_;  // not initialized
  std::unique_ptr<End[]> ends_;
  std::size_t capacity_ = 0;  // in vertices
  // Of another type than the links, so that these are not read again after each link is written.
  std::size_t full_ = 0;
  std::size_t limit_ = 0;
  std::size_t free_ = 0;  // at most limit_
};

}  // namespace rondel::bulk
