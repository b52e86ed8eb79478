// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The seam in a square: what the parts of the square hand up is triangulated, and what is final as
// seen from the square need not go further up (docs/theory/blocks.md, "A tree of seams").
//
//      .-----.-----.         Two parts, each with final faces that leave a seam along its border.
//      |.---.|.---.|         The edges between the seam and final faces are known. All faces of the
//      || F |||| F||         seam between the parts are new here; those along the outline of the
//      |'---'|'---'|         square stay open.
//      '-----'-----'
//
// in    sites of the square, and edges with a final face on the left, which is known elsewhere
// out   the new final faces, and what goes up: sites, and edges with nothing final on the right
// index local sites: 0, 1, ... in the order of the curve; sites that go up, by their own positions;
//       new final faces 0, 1, ...
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bulk/square_piece.h"
#include "topology/mesh.h"

namespace rondel::bulk {

// From a to b.
struct FinalEdge {
  Index a;
  Index b;
};

// A final face on the left of an edge: corner `corner` of the new face `face` is opposite. Or the
// face is the one that is known by edge `edge` of those that were handed in.
struct FinalSide {
  Index edge;  // or no_index, for a new face
  Index face;
  unsigned corner;
};

// An edge between two final faces: the new one on its left, and one that is known on its right.
struct DoneEdge {
  Index edge;  // of those handed in
  Index face;
  unsigned corner;
};

struct SquareSeam {
  std::vector<Triple> corners;    // of new faces, counterclockwise from the lowest local site
  std::vector<Triple> neighbors;  // new faces, or no_index where there is another one, or none
  std::vector<DoneEdge> done;
  std::vector<Index> sites;      // that go up, increasing
  std::vector<FinalEdge> edges;  // that go up, between positions in `sites`, and
  std::vector<FinalSide> sides;  // what is on their left
  std::vector<Index> hidden;     // of the local sites, increasing
};

template <models::SphereModel T>
class SquareSeamBuilder {
 public:
  // For the local sites 0, 1, ... that `input` lists, and edges between them. Without new faces, also
  // if this does not work, all that was handed in goes up as it is.
  SquareSeam build(const Input& input, const Square& square, std::span<const FinalEdge> edges) {
    if (!piece_.triangulate(input, square) || !mark(edges)) return {};
    const std::vector<Edge>& open = piece_.find_open(square);
    find_region(open);
    if (!is_consistent()) return {};
    SquareSeam seam;
    is_used_.assign(piece_.num_sites(), false);
    list_sites(open, seam);
    write_faces(seam);
    for (Index i = 0; i < edges.size(); ++i) {
      is_used_[edges[i].a] = is_used_[edges[i].b] = true;
      if (graph().face(known_[i] ^ 1) == open_face) hand_up(edges[i], {i, no_index, 0}, seam);
    }
    for (Index v = 0; v < is_used_.size(); ++v) {
      if (!is_used_[v]) seam.hidden.push_back(v);
    }
    return seam;
  }

  // Returns the tally of the last build.
  [[nodiscard]] Tally tally() const { return piece_.tally(); }

 private:
  using Edge = PlaneGraph::Edge;

  // The name of the face on the left of edge 0 of those handed in; below are 4 times the number of
  // a new face, and the corner opposite to the halfedge.
  static constexpr Index first_known = Index{1} << 31;

  [[nodiscard]] PlaneGraph& graph() { return piece_.graph(); }

  // Names the faces on the left of these edges. Returns false if one of the edges is missing.
  bool mark(std::span<const FinalEdge> edges) {
    PlaneGraph& graph = piece_.graph();
    edge_of_.assign(piece_.num_sites(), no_index);
    for (Edge e = 0; e < graph.edge_limit(); ++e) {
      if (graph.is_alive(e)) edge_of_[graph.origin(e)] = e;
    }
    known_.clear();
    for (const FinalEdge& edge : edges) {
      const Edge first = edge_of_[edge.a];
      if (first == no_index) return false;
      Edge e = first;
      while (graph.target(e) != edge.b) {
        e = graph.next(e);
        if (e == first) return false;
      }
      graph.set_face(e, first_known + static_cast<Index>(known_.size()));
      known_.push_back(e);
    }
    return true;
  }

  // Numbers all faces that can be reached from open ones without crossing a marked edge.
  void find_region(const std::vector<Edge>& open) {
    faces_.clear();
    for (const Edge e : open) enter(e ^ 1);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      Edge e = faces_[i];
      for (int side = 0; side < 3; ++side) {
        enter(e ^ 1);
        e = graph().face_next(e);
      }
    }
  }

  // The face on the left of e, unless it has a name.
  void enter(Edge e) {
    PlaneGraph& graph = piece_.graph();
    if (graph.face(e) != no_index) return;
    std::array<Edge, 3> sides = {e, graph.face_next(e), 0};
    sides[2] = graph.face_next(sides[1]);
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (graph.origin(sides[i]) < graph.origin(sides[lowest])) lowest = i;
    }
    const auto name = static_cast<Index>(4 * faces_.size());
    faces_.push_back(sides[lowest]);
    for (unsigned i = 0; i < 3; ++i) {
      graph.set_face(sides[(lowest + i) % 3], name + topology::previous_corner[i]);
    }
  }

  // Whether no search came to the left of a marked edge, and one to the right of each.
  [[nodiscard]] bool is_consistent() {
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (graph().face(known_[i]) != first_known + i) return false;
      const Index right = graph().face(known_[i] ^ 1);
      if (right == no_index || (right >= first_known && right != open_face)) return false;
    }
    return true;
  }

  void list_sites(const std::vector<Edge>& open, SquareSeam& seam) {
    for (const Edge e : open) is_used_[graph().origin(e)] = true;
    place_above_.assign(piece_.num_sites(), no_index);
    for (Index v = 0; v < is_used_.size(); ++v) {
      if (!is_used_[v]) continue;
      place_above_[v] = static_cast<Index>(seam.sites.size());
      seam.sites.push_back(v);
    }
  }

  void hand_up(const FinalEdge& edge, const FinalSide& side, SquareSeam& seam) {
    seam.edges.push_back({place_above_[edge.a], place_above_[edge.b]});
    seam.sides.push_back(side);
  }

  void write_faces(SquareSeam& seam) {
    PlaneGraph& graph = piece_.graph();
    seam.corners.resize(faces_.size());
    seam.neighbors.assign(faces_.size(), {no_index, no_index, no_index});
    for (Index face = 0; face < faces_.size(); ++face) {
      Edge e = faces_[face];
      for (unsigned i = 0; i < 3; ++i) {
        const Index v = graph.origin(e);
        seam.corners[face][i] = v;
        is_used_[v] = true;
        const unsigned opposite = topology::previous_corner[i];
        const Index right = graph.face(e ^ 1);
        if (right == open_face) {
          hand_up({v, graph.target(e)}, {no_index, face, opposite}, seam);
        } else if (right >= first_known) {
          seam.done.push_back({right - first_known, face, opposite});
        } else {
          seam.neighbors[face][opposite] = right / 4;
        }
        e = graph.face_next(e);
      }
    }
  }

  SquarePiece<T> piece_;
  std::vector<Edge> edge_of_;       // by local site
  std::vector<Edge> known_;         // the halfedges of the edges handed in
  std::vector<Edge> faces_;         // of each new face, the halfedge at its lowest corner
  std::vector<bool> is_used_;       // by local site: it has a final face, or goes up
  std::vector<Index> place_above_;  // by local site, among those that go up
};

}  // namespace rondel::bulk
