// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of a build, into which constraints are inserted one by one (arc_insertion.h).
//
// in    the faces of a triangulation, pairs of sites
// out   the faces that have these edges, in canonical order
// index vertices, which are names at first, as the build has them, and ranks in the spatial order
//       once number_by_rank() is called: then neighbors are close in memory, which is worth it if
//       many faces change; faces; halfedges 3 * face + i, the edge opposite to corner i
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

  // Lets constraints between names be edges where they are some already. Appends the others by ranks:
  // those that are no edges, or not among the first ones at an end. The first constraint has this
  // number. To be called before any insert(), best with constraints that are near each other.
  void constrain_edges(std::span<const std::array<Index, 2>> ends, Index first,
                       std::vector<ConstrainedPiece>& others);

  // Inserts the arc of a constraint between two ranks, not opposite to each other, and appends the
  // pieces of it, by names. If it crosses a constraint, some pieces are appended, and an edge of
  // that constraint is returned, by names; then nothing may be inserted any more.
  std::optional<std::array<Index, 2>> insert(const ConstrainedPiece& arc,
                                             std::vector<ConstrainedPiece>& pieces);
  // Lets vertices be ranks. Either this or constrain_edges() comes before the first insert().
  void number_by_rank(unsigned threads);

  [[nodiscard]] std::size_t num_sites() const { return sites_.size(); }
  [[nodiscard]] Index rank_of(Index name) const { return ranks_[name]; }
  [[nodiscard]] Index vertex_of(Index name) const { return is_by_rank_ ? ranks_[name] : name; }
  [[nodiscard]] Index name_of(Index vertex) const { return is_by_rank_ ? names_[vertex] : vertex; }

  // Moves the faces to the arrays that they were taken out of, in canonical order. Then nothing may
  // be called any more but has_changes().
  void give_back(unsigned threads, TriangulationArrays& arrays, std::vector<std::uint8_t>& sides);

  [[nodiscard]] bool has_changes() const { return has_changes_; }

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
  [[nodiscard]] const Point& point(Index v) const {
    return sites_[order_[is_by_rank_ ? v : ranks_[v]]];
  }
  [[nodiscard]] predicates::Vector direction(Index v) const {
    return predicates::direction(point(v), sphere_.center);
  }
  [[nodiscard]] Index rank_of_vertex(Index v) const { return is_by_rank_ ? v : ranks_[v]; }
  void rank_names(unsigned threads);
  void find_faces();
  bool constrain_edge(Index a, Index b);
  void start_with_owner(Index face);

  Sphere sphere_;
  std::span<const Point> sites_;
  std::vector<Index> order_;  // by rank: the site whose coordinates count
  std::vector<Index> names_;  // by rank
  LargeVector<Index> ranks_;  // by name
  bool is_by_rank_ = false;
  LargeVector<predicates::Vector> directions_;  // by vertex, if vertices are ranks
  LargeVector<Triple> faces_;
  LargeVector<Triple> neighbors_;
  std::vector<std::uint8_t> sides_;
  std::vector<std::uint8_t> states_;  // FaceState, by face
  LargeVector<Index> face_at_;  // a solid face at each vertex, its own first one if it has one
  std::vector<std::uint8_t> is_touched_;  // as in FacesToOrder, if vertices are ranks
  std::vector<ChangedFace> changed_;      // otherwise
  bool has_ghosts_ = false;
  bool has_changes_ = false;
  ArcInsertion<ConstrainedFaces> insertion_;
};

}  // namespace rondel::constrained
