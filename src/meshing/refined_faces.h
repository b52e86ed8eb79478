// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces of a constrained Delaunay triangulation into which vertices are inserted, and from which
// they are removed, one by one; after each operation it is constrained Delaunay again.
//
// A constrained edge is a segment. When a vertex divides it, two segments take its place; as the
// vertex is rounded to doubles, they bend by its error, which exact tests allow only where all
// faces remain positive. Free edges are flipped (Lawson) until each is locally Delaunay.
//
// in    a triangulation, and which of its edges are segments besides those that are constrained
// out   faces, vertices
// index faces; halfedges 3 * face + i, the edge opposite to corner i; vertices, those of the
//       triangulation under their numbers
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "predicates/points.h"
#include "rondel/constrained.h"
#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::mesh {

// A part of a constrained edge.
struct RefinedSegment {
  Index source;  // the edge of the triangulation it is a part of; no_index: a border of regions
  // The end of that edge whose distance decides where segments are divided; no_index: their middle.
  Index shell;
  // True if the face beyond is narrower than rounding and was cut off, so that what divides the
  // segment must not leave it to that side.
  bool is_cut_off = false;
};

struct RefinedFace {
  Triple vertex;
  std::array<Index, 3> opposite;  // halfedges; no_index: nothing is beyond
  std::array<Index, 3> segment;   // no_index: the edge is free
  Index region;                   // no_index: the face is not asked for
};

class RefinedFaces {
 public:
  // What a vertex may be: it was given, or it divides a segment, or it is in the inside.
  enum class VertexKind : std::uint8_t { given, on_segment, free };

  // Where a point is: in a face, or beyond a segment, which is the first one on the way to it.
  struct WalkEnd {
    Index face;
    Index blocked;  // the halfedge; no_index: the point is in the face
  };

  // Takes the solid faces of a triangulation around the origin. Edges between faces of different
  // regions become segments.
  // region  of each face of the triangulation
  RefinedFaces(const ConstrainedTriangulation& given, std::span<const Index> region);

  [[nodiscard]] const std::vector<RefinedFace>& faces() const { return faces_; }
  [[nodiscard]] const RefinedFace& face(Index f) const { return faces_[f]; }
  [[nodiscard]] bool is_alive(Index f) const { return faces_[f].vertex[0] != no_index; }
  [[nodiscard]] std::size_t num_vertices() const { return points_.size(); }
  [[nodiscard]] const Point& point(Index v) const { return points_[v]; }
  [[nodiscard]] const predicates::Vector& direction(Index v) const { return directions_[v]; }
  [[nodiscard]] VertexKind kind(Index v) const { return kinds_[v]; }
  [[nodiscard]] const RefinedSegment& segment(Index s) const { return segments_[s]; }
  [[nodiscard]] Index from(Index h) const;
  [[nodiscard]] Index to(Index h) const;
  [[nodiscard]] Index apex(Index h) const;

  // Goes from a face straight to a point. Nothing is returned if rounding leads astray.
  [[nodiscard]] std::optional<WalkEnd> locate(Index face, const predicates::Vector& point) const;

  // Inserts a free vertex in a face that locate() found. Returns nothing, and changes nothing, if
  // the point is not in the face or in the place of a corner; blocked() tells of a point on a
  // segment.
  std::optional<Index> insert(Index face, const predicates::Vector& point);
  // Divides the segment of a halfedge by a vertex. Returns nothing, and changes nothing, if a face
  // that is asked for would not be positive. The halves have the shells, from the beginning of the
  // halfedge, whose face is asked for.
  std::optional<Index> divide(Index h, const predicates::Vector& point,
                              const std::array<Index, 2>& shells);
  // Removes a free vertex, a corner of the face.
  void remove(Index vertex, Index face);

  // The faces that the last operation made or changed; some may be there twice.
  [[nodiscard]] std::span<const Index> changed() const { return changed_; }

 private:
  [[nodiscard]] Sign side(Index a, Index b, Index v) const;
  [[nodiscard]] Sign side(const predicates::Vector& p, Index h) const;
  [[nodiscard]] bool is_in_circle(const Triple& face, Index v) const;
  Index add_vertex(const predicates::Vector& point, VertexKind kind);
  Index add_face();
  void link(Index h, Index g);
  void take_edge(Index h, Index old);
  void flip(Index h);
  void legalize(bool is_star);
  void divide_faces(Index h, Index v);
  [[nodiscard]] bool fits(const predicates::Vector& point, Index h) const;
  [[nodiscard]] std::optional<predicates::Vector> moved_inside(const predicates::Vector& point,
                                                               Index h) const;

  std::vector<Point> points_;
  std::vector<predicates::Vector> directions_;
  std::vector<VertexKind> kinds_;
  std::vector<RefinedFace> faces_;
  std::vector<Index> free_faces_;
  std::vector<RefinedSegment> segments_;
  std::vector<Index> to_test_;  // halfedges that may not be locally Delaunay
  std::vector<Index> changed_;
};

}  // namespace rondel::mesh
