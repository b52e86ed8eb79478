// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of a build, into which constraints are inserted one by one (arc_insertion.h).
//
// in    the faces of a triangulation, pairs of vertices
// out   the faces that have these edges; in any order, those that were kept under their numbers
// index vertices along the spatial order, so that neighbors are close in memory; faces; halfedges
//       3 * face + i, the edge opposite to corner i
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "api/build.h"
#include "constrained/arc_insertion.h"
#include "constrained/constrained_order.h"
#include "constrained/constraints.h"
#include "predicates/points.h"
#include "rondel/types.h"
#include "system/large_arrays.h"
#include "topology/triangulation_arrays.h"

namespace rondel::constrained {

class ConstrainedFaces {
 public:
  // Takes the faces out of the arrays of a build, which are of dimension 2. The sites must outlive
  // the object.
  ConstrainedFaces(std::span<const Point> sites, api::Parts& built, const Sphere& sphere,
                   unsigned threads);

  // Inserts the arc of a constraint between two vertices, not opposite to each other, and appends
  // the pieces of it, by names. If it crosses a constraint, some pieces are appended, and an edge
  // of that constraint is returned, by names; then nothing may be inserted any more.
  std::optional<std::array<Index, 2>> insert(const ConstrainedPiece& arc,
                                             std::vector<ConstrainedPiece>& pieces);

  [[nodiscard]] Index vertex_of(Index name) const { return vertices_[name]; }
  [[nodiscard]] Index name_of(Index vertex) const { return names_[vertex]; }

  // Lets all faces start with their owners (topology/canonical_order.h), as those do that did not
  // change, and returns them. Then no arc may be inserted any more.
  [[nodiscard]] FacesToOrder to_order();
  // Moves all faces as they are, with names as corners, to arrays.
  void give_back(TriangulationArrays& arrays);

  [[nodiscard]] bool has_changes() const { return has_changes_; }
  [[nodiscard]] const std::vector<std::uint8_t>& sides() const { return sides_; }

  // These are what ArcInsertion asks for.
  [[nodiscard]] bool is_solid(Index face) const { return (states_[face] & ghost_face) == 0; }
  [[nodiscard]] const Triple& corners(Index face) const { return faces_[face]; }
  [[nodiscard]] Index neighbor(Index face, unsigned edge) const { return neighbors_[face][edge]; }
  [[nodiscard]] Index opposite(Index halfedge) const;
  [[nodiscard]] Index solid_face_at(Index vertex) const { return face_at_[vertex]; }
  [[nodiscard]] bool is_constrained(Index h) const {
    return (static_cast<unsigned>(sides_[h / 3]) >> h % 3 & 1U) != 0;
  }
  [[nodiscard]] Sign side(Index a, Index b, Index v) const;
  [[nodiscard]] bool is_in_circle(Index a, Index b, Index c, Index v) const;
  void put_in_cavity(Index face);
  [[nodiscard]] bool is_in_cavity(Index face) const {
    return (states_[face] & face_in_cavity) != 0;
  }
  void replace(Index face, const Triple& corners);
  void link(Index h, Index g);
  void constrain_side(Index h);
  void constrain(Index h);

 private:
  [[nodiscard]] bool is_changed(Index face) const { return (states_[face] & changed_face) != 0; }
  void number_vertices(unsigned threads);
  void rename_corners(unsigned threads, std::span<const Index> names);
  [[nodiscard]] const Point& point(Index v) const { return sites_[order_[v]]; }

  Sphere sphere_;
  std::span<const Point> sites_;
  std::vector<Index> order_;  // by vertex: the site whose coordinates count
  std::vector<Index> names_;
  LargeVector<Index> vertices_;  // by name
  LargeVector<predicates::Vector> directions_;
  LargeVector<Triple> faces_;
  LargeVector<Triple> neighbors_;
  std::vector<std::uint8_t> sides_;
  std::vector<std::uint8_t> states_;  // FaceState, by face
  LargeVector<Index> face_at_;        // a solid face at each vertex
  std::vector<std::uint8_t> is_touched_;
  bool has_changes_ = false;
  ArcInsertion<ConstrainedFaces> insertion_;
};

}  // namespace rondel::constrained
