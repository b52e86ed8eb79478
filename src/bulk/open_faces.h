// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The certificate of a block: which faces of its triangulation are faces of the whole one.
//
// in    the graph of a block, its square, and its sites as seen from the center
// out   the open faces, named in the graph: those that are not known to be final
// index local sites and halfedges of the graph
//
// A face is final if no other site can be in conflict with it. All sites within the square are in
// the block, and all sites lie within the distance R of the center; so it is final if the cap that
// its plane cuts off the ball of radius R lies in the cone of the square. The others are open. A
// site outside the square is in conflict with a connected set of faces that reaches the outer
// boundary, so a search from there meets all open faces.
#pragma once

#include <array>
#include <vector>

#include "bulk/plane_graph.h"
#include "bulk/squares.h"
#include "predicates/points.h"

namespace rondel::bulk {

// The cone: inward normals of unit length of the planes that bound it.
using Cone = std::array<predicates::Vector, 4>;

class Certificate {
 public:
  Certificate(const Cone& cone, bool has_weights) : cone_(cone), has_weights_(has_weights) {}
  // For the cone of a square, in the axes of SquareSites::ray, whose hand this is.
  Certificate(const Square& square, double hand, bool has_weights);

  // Whether a face is final. Its sites are given as seen from the center: within 11 units of a unit
  // vector, or, with weights, within 7 units of a vector of at most unit length.
  [[nodiscard]] bool is_final(const predicates::Vector& a, const predicates::Vector& b,
                              const predicates::Vector& c) const;

 private:
  Cone cone_;
  bool has_weights_;
};

// Names the open faces in the graph, the outer one included; `boundary` is an edge with the outer
// face on its right. No other face has a name, or the search does not enter it. is_final(i, j, k)
// judges the face of these sites. Lists the halfedges with an open face on the left.
template <class IsFinal>
void find_open_faces(PlaneGraph& graph, PlaneGraph::Edge boundary,
                     std::vector<PlaneGraph::Edge>& open, IsFinal is_final) {
  open.clear();
  const auto add = [&](PlaneGraph::Edge e) {
    graph.set_face(e, open_face);
    open.push_back(e);
  };
  PlaneGraph::Edge e = boundary;
  do {
    add(e ^ 1);
    e = graph.next(e ^ 1);
  } while (e != boundary);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const PlaneGraph::Edge f = open[i] ^ 1;
    if (graph.face(f) != no_index) continue;
    const PlaneGraph::Edge g = graph.face_next(f);
    const PlaneGraph::Edge h = graph.face_next(g);
    if (is_final(graph.origin(f), graph.origin(g), graph.origin(h))) continue;
    for (const PlaneGraph::Edge side : {f, g, h}) add(side);
  }
}

}  // namespace rondel::bulk
