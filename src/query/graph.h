// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What queries run on: a graph of vertices with exact traits. There are two: the closed surface of
// dimension 2, and the ring of the dimensions below. Searches for near vertices ask both alike.
//
// Queries for near vertices rest on one property. With f(v) the closeness of vertex v to the query
// (the cosine of the angle, or the scalar product of the weighted model), the vertices with
// f >= c are connected by edges, for every c. Proof: f is linear in the positions. The surface is
// the boundary of a convex body whose vertices have been moved by infinitesimals
// (docs/theory/perturbation.md); on it, whoever climbs along edges from a vertex meets no local
// maximum but the global one, so for moved positions {f > c'} is connected. With c' below c
// and above the next smaller value of f, the same set is {f >= c} for the positions as they are.
#pragma once

#include <concepts>
#include <span>
#include <variant>

#include "kernel/walk.h"
#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "query/ring_location.h"
#include "topology/mesh.h"

namespace rondel::query {

// Vertices have internal names: whatever the mesh and the traits use. `name` is what a vertex is
// called outside; ties go to the smallest name.
template <class G>
concept Graph = requires(const G& graph, Index v, bool (*visit)(Index)) {
  graph.sites;
  { graph.name(v) } -> std::same_as<Index>;
  // Calls visit for the neighbors, counterclockwise, until it returns true.
  graph.visit_neighbors(v, visit);
};

template <models::SphereTraits T>
struct SurfaceGraph {
  const T& sites;
  const topology::Mesh& mesh;  // may have slots that are not alive
  const kernel::FaceKinds& kinds;
  std::span<const topology::Halfedge>
      corner_of;  // of a vertex: 3*face + corner of one of its faces
  std::span<const Index> names;
  Index solid_face;             // some solid face
  Index entry_face = no_index;  // some entry face, if there is one

  [[nodiscard]] Index name(Index v) const { return names[v]; }

  // Calls visit(3*face + corner) for the corners at v, counterclockwise, until it returns true.
  template <class Visit>
  void visit_corners(Index v, Visit&& visit) const {
    const topology::Halfedge first = corner_of[v];
    topology::Halfedge h = first;
    do {
      if (visit(h)) return;
      h = mesh.next_around(topology::face_of(h), topology::edge_of(h));
    } while (h != first);
  }

  template <class Visit>
  void visit_neighbors(Index v, Visit&& visit) const {
    visit_corners(v, [&](topology::Halfedge h) {
      const topology::Face& face = mesh[topology::face_of(h)];
      return visit(face.vertex[topology::next_corner[topology::edge_of(h)]]);
    });
  }
};

// Dimensions 0 and 1: vertex i is at place i of a ring.
template <models::SphereTraits T>
struct RingGraph {
  const T& sites;
  std::span<const Index> names;
  RingLocation location;

  [[nodiscard]] Index name(Index v) const { return names[v]; }

  template <class Visit>
  void visit_neighbors(Index v, Visit&& visit) const {
    const auto size = static_cast<Index>(names.size());
    if (size < 2) return;
    if (visit(v + 1 < size ? v + 1 : 0) || size == 2) return;
    visit(v > 0 ? v - 1 : size - 1);
  }
};

// Refers to what a finished triangulation (built.h) or one that changes (Editor::graph()) keeps.
using AnyGraph =
    std::variant<SurfaceGraph<models::ProjectedPoints>, SurfaceGraph<models::WeightedPoints>,
                 RingGraph<models::ProjectedPoints>, RingGraph<models::WeightedPoints>>;

}  // namespace rondel::query
