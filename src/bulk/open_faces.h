// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The certificate of a block: which faces of its triangulation are faces of the whole one.
//
// A face is final if no other site can be in conflict with it. All sites within the square are in
// the block, and all sites lie within the distance R of the center; so it is final if the cap that
// its plane cuts off the ball of radius R lies in the cone of the square. The others are open. A
// site outside the square is in conflict with a connected set of faces that reaches the outer
// boundary, so a search from there meets all open faces.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "bulk/plane_graph.h"
#include "bulk/squares.h"
#include "predicates/rung.h"

namespace rondel::bulk {

// The name of an open face in the graph, and of one that has no name yet.
inline constexpr Index open_face = no_index - 1;
inline constexpr Index unnamed_face = no_index;

// The cone: inward normals of unit length of the planes that bound it.
using Cone = std::array<predicates::Vector, 4>;

// The cone of a square, in the axes of SquareSites::ray.
Cone make_cone(const Square& square, double hand);

class OpenFaces {
 public:
  // `ray` gives a site as seen from the center: within 11 units of a unit vector, or, with weights,
  // within 7 units of a vector of at most unit length.
  using Ray = std::function<predicates::Vector(Index)>;
  OpenFaces(PlaneGraph& graph, Ray ray, const Cone& cone, bool has_weights)
      : graph_(graph), ray_(std::move(ray)), cone_(cone), has_weights_(has_weights) {}

  // Names the open faces in the graph, the outer one included; `boundary` is an edge with the outer
  // face on its right. Returns the halfedges with an open face on the left.
  const std::vector<PlaneGraph::Edge>& find(PlaneGraph::Edge boundary);

 private:
  [[nodiscard]] bool is_final(Index i, Index j, Index k) const;

  PlaneGraph& graph_;
  Ray ray_;
  const Cone& cone_;
  bool has_weights_;
  std::vector<PlaneGraph::Edge> open_;
};

}  // namespace rondel::bulk
