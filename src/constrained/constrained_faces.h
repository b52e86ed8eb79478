// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces into which constraints are inserted one by one; docs/theory/constrained.md has the proof.
//
//            left chain                An arc from v to w crosses the edges of the faces of its
//            o----o----o               cavity. They are replaced by triangulations of the two
//          / |  / | \  | \             polygons beside the arc: left of v -> w and left of w -> v.
//        v --+-/--+--\-+-- w           A polygon may touch itself, where an edge has its faces on
//          \ |/   |   \| /             both sides in the cavity.
//            o----o----o
//            right chain
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
  [[nodiscard]] std::size_t num_vertices() const { return names_.size(); }

  // Lets all faces start with their owners (topology/canonical_order.h), as those do that did not
  // change. Then no arc may be inserted any more.
  void start_with_owners();
  // True if a face that changed has, or had, this owner; known when faces start with their owners.
  [[nodiscard]] bool is_touched(Index vertex) const { return is_touched_[vertex] != 0; }
  // Moves all faces as they are, with names as corners, to arrays.
  void give_back(TriangulationArrays& arrays);

  [[nodiscard]] bool has_changes() const { return has_changes_; }
  [[nodiscard]] bool is_changed(Index face) const { return (states_[face] & changed) != 0; }
  [[nodiscard]] bool is_solid(Index face) const { return (states_[face] & ghost) == 0; }
  [[nodiscard]] const LargeVector<Triple>& faces() const { return faces_; }
  [[nodiscard]] const LargeVector<Triple>& neighbors() const { return neighbors_; }
  [[nodiscard]] const std::vector<std::uint8_t>& sides() const { return sides_; }
  // Returns the same edge seen from the other face.
  [[nodiscard]] Index opposite(Index halfedge) const;

 private:
  // What is true of a face: it is a ghost face, it was made by an insertion, it is in the cavity.
  static constexpr std::uint8_t ghost = 1;
  static constexpr std::uint8_t changed = 2;
  static constexpr std::uint8_t in_cavity = 4;

  // How an arc leaves a vertex: along the halfedge, or across it if the vertex is opposite to it.
  struct Departure {
    Index halfedge;
    bool is_along;
  };
  // The solid faces around a vertex, one after the other, counterclockwise and then clockwise from
  // the first one.
  class Fan;

  // An edge of a polygon: from vertex i of its chain to vertex i + 1.
  struct PolygonEdge {
    Index inner;     // the halfedge in the cavity, backwards
    Index outer;     // its opposite
    bool is_double;  // the opposite is in the cavity, too
    bool is_constrained;
  };
  // Vertices from one end of an arc to the other one, and the edges between them.
  struct Polygon {
    std::vector<Index> vertices;
    std::vector<PolygonEdge> edges;
    void clear() {
      vertices.clear();
      edges.clear();
    }
  };
  struct SubPolygon {
    Index first;
    Index last;
    Index halfedge;  // of the face beyond its base; no_index: none yet
  };
  // Two halfedges of new faces that are opposite to each other if the old one is the same.
  struct DoubleEdge {
    Index old;
    Index halfedge;
  };

  void number_vertices(unsigned threads);
  void rename_corners(unsigned threads, std::span<const Index> names);
  [[nodiscard]] const Point& point(Index v) const { return sites_[order_[v]]; }
  [[nodiscard]] Sign side(Index a, Index b, Index v) const;
  [[nodiscard]] bool is_in_circle(Index a, Index b, Index c, Index v) const;
  [[nodiscard]] Departure departure(Index& a, Index& b) const;
  [[nodiscard]] bool is_constrained(Index h) const {
    return (static_cast<unsigned>(sides_[h / 3]) >> h % 3 & 1U) != 0;
  }
  void link(Index h, Index g);
  void constrain(Index halfedge);
  std::optional<std::array<Index, 2>> dig(Index a, Index b, Index halfedge);
  void append(Polygon& polygon, Index vertex, Index halfedge);
  void refill();
  void look_outside(Polygon& polygon);
  Index fill(const Polygon& polygon);
  void close(const PolygonEdge& edge, Index halfedge);
  [[nodiscard]] Index apex_of(const Polygon& polygon, Index first, Index last) const;
  Index add_face(Index a, Index b, Index c);

  Sphere sphere_;
  std::span<const Point> sites_;
  std::vector<Index> order_;  // by vertex: the site whose coordinates count
  std::vector<Index> names_;
  LargeVector<Index> vertices_;  // by name
  LargeVector<predicates::Vector> directions_;
  LargeVector<Triple> faces_;
  LargeVector<Triple> neighbors_;
  std::vector<std::uint8_t> sides_;
  std::vector<std::uint8_t> states_;
  LargeVector<Index> face_at_;  // a solid face at each vertex
  std::vector<std::uint8_t> is_touched_;
  bool has_changes_ = false;

  // The rest belongs to the arc that is inserted.
  std::vector<Index> cavity_;
  Polygon left_;
  Polygon right_;  // from the same end as left_ until it is filled
  std::vector<SubPolygon> to_fill_;
  std::vector<DoubleEdge> double_edges_;
};

}  // namespace rondel::constrained
