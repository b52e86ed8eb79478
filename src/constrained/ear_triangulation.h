// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulates a polygon beside an arc that need not be convex: cuts off ears, and flips edges.
//
//        3 ---- 2        From each corner an edge of the old faces leads to the arc, edge 0, and no two of
//       /        \       these cross. So a corner that is convex is an ear: an edge that would come into
//      4    5     1      its triangle would have to cross the edge of a neighbor. That stays true when an
//       \  / \   /       ear is cut off.
//        0 ------
//
// Neighbors are cut off in different rounds, so that a convex chain gets few edges that have to be
// flipped. A chain that is bent towards the arc has one triangulation alone, which needs no flips,
// and which halving the polygon at one apex after the other would take quadratic time for.
//
// in    faces, as ArcInsertion asks for them; the corners of a polygon, counterclockwise
// out   its Delaunay triangulation, whose vertices are positions in the list of corners
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::constrained {

class EarTriangulation {
 public:
  // Returns false if there are not enough ears, or too many edges to flip; faces() is invalid then.
  template <class Faces>
  bool run(Faces& faces, std::span<const Index> ring) {
    start(static_cast<Index>(ring.size()));
    return cut_ears(faces, ring) && flip_edges(faces, ring);
  }
  // An edge of the polygon has no opposite.
  [[nodiscard]] std::span<const topology::Face> faces() const { return faces_; }

 private:
  void start(Index size) {
    next_.resize(size);
    previous_.resize(size);
    outer_.assign(size, no_index);
    round_of_.assign(size, 0);
    to_try_.clear();
    for (Index i = 0; i < size; ++i) {
      next_[i] = i + 1 < size ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : size - 1;
      if (i > 1) to_try_.push_back(i);
    }
    faces_.clear();
    to_flip_.clear();
  }

  template <class Faces>
  [[nodiscard]] static bool is_convex(const Faces& faces, std::span<const Index> ring, Index p,
                                      Index u, Index q) {
    return ring[p] != ring[q] && faces.side(ring[p], ring[u], ring[q]) == Sign::positive;
  }

  void link(topology::Halfedge h, topology::Halfedge other) {
    faces_[topology::face_of(h)].opposite[topology::edge_of(h)] = other;
    if (other == no_index) return;
    faces_[topology::face_of(other)].opposite[topology::edge_of(other)] = h;
  }

  // Adds the face of an ear, whose edge opposite to it becomes one of what is left.
  void cut(Index p, Index u, Index q) {
    const auto face = static_cast<Index>(faces_.size());
    faces_.push_back({{p, u, q}, {no_index, no_index, no_index}});
    link(topology::halfedge(face, 0), outer_[u]);
    link(topology::halfedge(face, 2), outer_[p]);
    outer_[p] = topology::halfedge(face, 1);
    to_flip_.push_back(outer_[p]);
    next_[p] = q;
    previous_[q] = p;
    next_[u] = no_index;  // no longer there
  }

  template <class Faces>
  bool cut_ears(const Faces& faces, std::span<const Index> ring) {
    std::size_t left = ring.size();
    for (Index round = 1; left > 3 && !to_try_.empty(); ++round) {
      try_next_.clear();
      for (const Index u : to_try_) {
        if (left == 3) break;
        const Index p = previous_[u];
        const Index q = next_[u];
        if (q == no_index || round_of_[u] == round || !is_convex(faces, ring, p, u, q)) continue;
        cut(p, u, q);
        --left;
        for (const Index neighbor : {p, q}) {
          if (neighbor < 2 || round_of_[neighbor] == round) continue;
          round_of_[neighbor] = round;
          try_next_.push_back(neighbor);
        }
      }
      to_try_.swap(try_next_);
    }
    if (left > 3 || !is_convex(faces, ring, 0, 1, next_[1])) return false;
    const Index apex = next_[1];
    const auto face = static_cast<Index>(faces_.size());
    faces_.push_back({{0, 1, apex}, {no_index, no_index, no_index}});
    link(topology::halfedge(face, 0), outer_[1]);
    link(topology::halfedge(face, 1), outer_[apex]);
    return true;
  }

  // Flips edges until all are locally Delaunay.
  template <class Faces>
  bool flip_edges(Faces& faces, std::span<const Index> ring) {
    std::size_t flips_left = 16 * ring.size();
    while (!to_flip_.empty()) {
      const topology::Halfedge h = to_flip_.back();
      to_flip_.pop_back();
      const topology::Halfedge o = faces_[topology::face_of(h)].opposite[topology::edge_of(h)];
      if (o == no_index) continue;
      const Index apex = ring[faces_[topology::face_of(o)].vertex[topology::edge_of(o)]];
      const auto& [a, b, c] = faces_[topology::face_of(h)].vertex;
      if (ring[a] == apex || ring[b] == apex || ring[c] == apex) continue;
      if (!faces.is_in_circle(ring[a], ring[b], ring[c], apex)) continue;
      if (flips_left-- == 0 || !flip(faces, ring, h, o)) return false;
    }
    return true;
  }

  // Replaces the edge between two faces by the other diagonal. Returns false if that is outside.
  template <class Faces>
  bool flip(const Faces& faces, std::span<const Index> ring, topology::Halfedge h,
            topology::Halfedge o) {
    const Index f = topology::face_of(h);
    const Index g = topology::face_of(o);
    const topology::Face first = faces_[f];
    const topology::Face second = faces_[g];
    const unsigned i = topology::edge_of(h);
    const unsigned j = topology::edge_of(o);
    const Index p = first.vertex[i];
    const Index q = second.vertex[j];
    const Index a = first.vertex[topology::next_corner[i]];
    const Index b = first.vertex[topology::previous_corner[i]];
    if (!is_convex(faces, ring, p, a, q) || !is_convex(faces, ring, q, b, p)) return false;
    faces_[f].vertex = {p, a, q};
    faces_[g].vertex = {q, b, p};
    link(topology::halfedge(f, 0), second.opposite[topology::next_corner[j]]);
    link(topology::halfedge(f, 1), topology::halfedge(g, 1));
    link(topology::halfedge(f, 2), first.opposite[topology::previous_corner[i]]);
    link(topology::halfedge(g, 0), first.opposite[topology::next_corner[i]]);
    link(topology::halfedge(g, 2), second.opposite[topology::previous_corner[j]]);
    for (const Index face : {f, g}) {
      to_flip_.push_back(topology::halfedge(face, 0));
      to_flip_.push_back(topology::halfedge(face, 2));
    }
    return true;
  }

  std::vector<topology::Face> faces_;
  std::vector<Index> next_;  // of the corners that are left; no_index if one is not
  std::vector<Index> previous_;
  std::vector<topology::Halfedge> outer_;  // the face behind the edge from a corner to the next one
  std::vector<Index> round_of_;            // the last round in which a neighbor was cut off
  std::vector<Index> to_try_;
  std::vector<Index> try_next_;
  std::vector<topology::Halfedge> to_flip_;
};

}  // namespace rondel::constrained
