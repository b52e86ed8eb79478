// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The data structure of divide and conquer: a graph drawn without crossings, without coordinates.
// A graph also holds what a triangulation cannot: single edges, chains, an outer face.
//
//            c         Halfedges come in pairs e, e^1. Those that leave one vertex form a ring:
//           / \        next(e) is the one counterclockwise after e, previous(e) the one before.
//   next(e)/   \       The face to the left of e runs on with face_next(e), and the outer face
//         /  f  \      lies to the left of the halfedges that have it there, too.
//        a---e---b
//
// (Guibas and Stolfi, ACM Trans. Graph. 4, 1985, without the dual graph.)
//
// in    vertices by number, edges one by one
// out   rings of edges around vertices and faces
// index local sites are the vertices; an edge is a halfedge; a name of a face is what the user says
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "rondel/types.h"

namespace rondel::bulk {

// The name of a face that is not final (open_faces.h).
inline constexpr Index open_face = no_index - 1;

class PlaneGraph {
 public:
  using Edge = Index;  // a halfedge

  // Elements of eight bytes or less, which machines address by their index.
  struct Links {
    Edge next;
    Edge previous;
  };

  static constexpr std::size_t halfedge_bytes = sizeof(Links) + 2 * sizeof(Index);

  PlaneGraph() = default;
  // A graph without edges, in memory of the caller for `size` halfedges, which several graphs may
  // share: this one has 6 * num_vertices + 2, from `first` on. Deleted pairs are used again, and a
  // plane graph has less than three edges a vertex; one pair more is always ready (new_pair()).
  PlaneGraph(std::byte* memory, std::size_t size, std::size_t first, std::size_t num_vertices)
      : rings_(reinterpret_cast<Links*>(memory)),
        targets_(reinterpret_cast<Index*>(rings_ + size)),
        faces_(targets_ + size),
        begin_(first),
        full_(first + 6 * num_vertices),
        limit_(first),
        free_(first) {
    rings_[first].next = static_cast<Edge>(first + 2);
  }

  // Takes over the edges of the graph that follows in the same memory.
  void append(const PlaneGraph& next) {
    // Pairs that were never used become deleted ones.
    for (std::size_t e = limit_; e < next.begin_; e += 2) {
      targets_[e] = no_index;
      targets_[e + 1] = no_index;
      const std::size_t following = e + 2 < next.begin_ ? e + 2 : next.free_;
      rings_[e].next = static_cast<Edge>(following);
    }
    full_ = next.full_;
    limit_ = next.limit_;
  }

  // For loops: the same arrays without a look at this object for each element.
  [[nodiscard]] const Links* rings() const { return rings_; }
  [[nodiscard]] Index* targets() { return targets_; }
  [[nodiscard]] Index* faces() { return faces_; }

  [[nodiscard]] Edge next(Edge e) const { return rings_[e].next; }
  [[nodiscard]] Edge previous(Edge e) const { return rings_[e].previous; }
  // Either of them.
  template <bool is_next>
  [[nodiscard]] Edge following(Edge e) const {
    return is_next ? rings_[e].next : rings_[e].previous;
  }
  [[nodiscard]] Index target(Edge e) const { return targets_[e]; }
  [[nodiscard]] Index origin(Edge e) const { return targets_[e ^ 1]; }
  [[nodiscard]] Edge face_next(Edge e) const { return rings_[e ^ 1].previous; }

  // What the user wants to remember of the face on the left; no_index after clear_faces().
  void clear_faces() { std::fill(faces_ + begin_, faces_ + limit_, no_index); }
  [[nodiscard]] Index face(Edge e) const { return faces_[e]; }
  void set_face(Edge e, Index face) { faces_[e] = face; }

  // Halfedges are below this; those of deleted pairs have no target.
  [[nodiscard]] Edge edge_limit() const { return static_cast<Edge>(limit_); }
  [[nodiscard]] bool is_alive(Edge e) const { return targets_[e] != no_index; }

  [[nodiscard]] std::size_t num_edges() const {
    std::size_t count = (limit_ - begin_) / 2;
    for (std::size_t e = free_; e != limit_; e = rings_[e].next) --count;
    return count;
  }

  // Whether there are as many edges as a plane graph can have, so that no more may be added.
  [[nodiscard]] bool is_full() const { return free_ == full_; }

  // Pairs without ends and rings.
  template <std::size_t N>
  std::array<Edge, N> new_pairs() {
    std::array<Edge, N> pairs;
    for (Edge& e : pairs) e = new_pair();
    return pairs;
  }

  struct EdgeTo {
    Edge edge;
    Index target;
  };
  // All halfedges of a vertex, counterclockwise.
  template <std::size_t N>
  void set_ring(const std::array<EdgeTo, N>& ring) {
    for (std::size_t i = 0; i < N; ++i) {
      rings_[ring[i].edge] = {ring[(i + 1) % N].edge, ring[(i + N - 1) % N].edge};
      targets_[ring[i].edge] = ring[i].target;
    }
  }

  // The first of so many new pairs, one behind the other and in no ring yet; no_index if there are deleted
  // ones, which are to be used first.
  Edge new_pairs_in_row(std::size_t num) {
    if (free_ != limit_) return no_index;
    const std::size_t e = limit_;
    free_ = limit_ += 2 * num;
    rings_[limit_].next = static_cast<Edge>(limit_ + 2);
    return static_cast<Edge>(e);
  }
  // The ends of a pair, the halfedge e from a to b.
  void set_ends(Edge e, Index a, Index b) {
    targets_[e] = b;
    targets_[e + 1] = a;
  }

  // Makes f the halfedge after e in the ring of their vertex.
  void link(Edge e, Edge f) {
    rings_[e].next = f;
    rings_[f].previous = e;
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
    return add(a, b, {rings_[f].next, f}, {rings_[g].next, g});
  }
  // A new pair from a to b, given the edges next to it in both rings.
  [[gnu::always_inline]] Edge add(Index a, Index b, const Links& at_a, const Links& at_b) {
    const Edge e = new_pair();
    rings_[e] = at_a;
    rings_[e + 1] = at_b;
    targets_[e] = b;
    targets_[e + 1] = a;
    rings_[at_a.previous].next = e;
    rings_[at_a.next].previous = e;
    rings_[at_b.previous].next = e + 1;
    rings_[at_b.next].previous = e + 1;
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
  [[gnu::always_inline]] void remove(Edge e) {
    unlink(e);
    unlink(e ^ 1);
    targets_[e] = no_index;
    targets_[e ^ 1] = no_index;
    rings_[e & ~Edge{1}].next = static_cast<Edge>(free_);
    free_ = e & ~Edge{1};
  }

 private:
  // The list of deleted pairs runs on with those never used, which saves a branch that would depend
  // on the input: the first of these is always ready.
  [[gnu::always_inline]] Edge new_pair() {
    const std::size_t e = std::exchange(free_, rings_[free_].next);
    limit_ = std::max(limit_, e + 2);
    rings_[limit_].next = static_cast<Edge>(limit_ + 2);
    return static_cast<Edge>(e);
  }

  [[gnu::always_inline]] void unlink(Edge e) {
    const Links links = rings_[e];
    rings_[links.previous].next = links.next;
    rings_[links.next].previous = links.previous;
  }

  Links* rings_ = nullptr;
  Index* targets_ = nullptr;
  Index* faces_ = nullptr;
  // These are of another type than the links, so that they are not read again after each link is
  // written.
  std::size_t begin_ = 0;
  std::size_t full_ = 0;
  std::size_t limit_ = 0;
  std::size_t free_ = 0;  // at most limit_
};

// A part of a graph, by a vertex of its outer boundary and the edge that leaves it there,
// with the outer face on its right; no edge for a single vertex, no vertex for no sites.
struct Part {
  Index vertex = no_index;
  PlaneGraph::Edge edge = no_index;
};

// The part by the next vertex of its boundary, counterclockwise.
inline Part next_on_boundary(const PlaneGraph& graph, const Part& p) {
  return {graph.target(p.edge), graph.next(p.edge ^ 1)};
}

// Lists the vertices without a path to this edge, and deletes their edges.
std::vector<Index> remove_unreached(PlaneGraph& graph, PlaneGraph::Edge start, Index num_vertices);

}  // namespace rondel::bulk
