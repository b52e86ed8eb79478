// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where a direction p is among the solid faces of a constrained triangulation, by exact
// orientations. There a walk that crosses any edge that p is beyond may go in circles. So it has
// two parts:
//
// 1. It crosses edges that p is beyond, but none that is constrained. Each step raises n.p, where n
//    is the vector with n.x = 1 on the plane of the face, ties being broken; so it ends.
// 2. If it ends at a constrained edge that p is beyond, it goes on along the arc from a corner of
//    the face to p, which comes to no face twice.
//
// docs/theory/constrained.md has the proofs.
//
// in    the mesh, the kinds of its faces, their constrained sides; a solid face to start from
// out   the face, edge or vertex that has p, or an edge of the border that p is beyond
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "kernel/walk.h"
#include "query/locate.h"
#include "rondel/query.h"
#include "topology/mesh.h"

namespace rondel::constrained {

// `halfedge` is in a solid face: any one of it, the edge that has p, the one opposite to the vertex
// that has p, or, if p is outside, one of the border with p strictly beyond it.
struct ConstrainedWalkEnd {
  Where where;
  topology::Halfedge halfedge;
};

// `oriented(a, b, c)` is the exact orientation of vertices of the mesh, or of p.
template <class Oriented>
class ConstrainedWalk {
 public:
  // `sides` are bits by face, as in ConstrainedTriangulation.
  ConstrainedWalk(const Oriented& oriented, const topology::Mesh& mesh,
                  const kernel::FaceKinds& kinds, std::span<const std::uint8_t> sides, Index p)
      : oriented_(oriented),
        mesh_(mesh),
        kinds_(kinds),
        sides_(sides),
        p_(p),
        steps_left_(16 * (std::size_t{mesh.num_slots()} + 1)) {}

  // Finds p from a solid face on. Throws InvalidInput at last if the sites are not those that were
  // triangulated.
  [[nodiscard]] ConstrainedWalkEnd locate(Index f) {
    unsigned entered = 3;
    for (;;) {
      count_step();
      std::array<Sign, 3> side = {Sign::positive, Sign::positive, Sign::positive};
      unsigned i = 0;
      bool is_beyond_constraint = false;
      for (; i < 3; ++i) {
        if (i == entered) continue;
        side[i] = side_of_edge(topology::halfedge(f, i));
        if (side[i] != Sign::negative) continue;
        if (!is_solid(mesh_.neighbor(f, i))) return {Where::outside, topology::halfedge(f, i)};
        if (!is_constrained(f, i)) break;
        is_beyond_constraint = true;
      }
      if (i == 3) return is_beyond_constraint ? follow_arc(f) : inside(f, side);
      const topology::Halfedge h = mesh_[f].opposite[i];
      f = topology::face_of(h);
      entered = topology::edge_of(h);
    }
  }

 private:
  // A corner of a face.
  struct FaceCorner {
    Index face;
    unsigned corner;
  };
  // How the arc from a vertex leaves it: by a face, and there along one of the two edges at the
  // vertex, or across the third one.
  enum class ArcStep : std::uint8_t { across, along_next, along_previous };
  struct ArcDeparture {
    FaceCorner at;
    ArcStep step;
  };

  // A face is visited at most once by each part of the walk, and its corners once each by the turns
  // around vertices.
  void count_step() {
    if (steps_left_-- == 0) query::refuse_sites();
  }
  [[nodiscard]] bool is_solid(Index f) const { return kinds_[f] == kernel::FaceKind::solid; }
  [[nodiscard]] bool is_constrained(Index f, unsigned edge) const {
    return (static_cast<unsigned>(sides_[f]) >> edge & 1U) != 0;
  }
  [[nodiscard]] Index vertex(const FaceCorner& at) const {
    return mesh_[at.face].vertex[at.corner];
  }
  [[nodiscard]] Sign oriented(Index a, Index b, Index c) const { return oriented_(a, b, c); }
  // Positive if p is on the side of the face of a halfedge.
  [[nodiscard]] Sign side_of_edge(topology::Halfedge h) const {
    const auto& v = mesh_[topology::face_of(h)].vertex;
    return oriented(v[topology::next_corner[topology::edge_of(h)]],
                    v[topology::previous_corner[topology::edge_of(h)]], p_);
  }

  // p is beyond no edge of the face.
  [[nodiscard]] static ConstrainedWalkEnd inside(Index f, const std::array<Sign, 3>& side) {
    unsigned num_zeros = 0;
    unsigned zero = 0;
    unsigned other = 0;
    for (unsigned i = 0; i < 3; ++i) {
      num_zeros += side[i] == Sign::zero ? 1 : 0;
      (side[i] == Sign::zero ? zero : other) = i;
    }
    if (num_zeros == 0) return {Where::face, topology::halfedge(f, 0)};
    if (num_zeros == 1) return {Where::edge, topology::halfedge(f, zero)};
    return {Where::vertex, topology::halfedge(f, other)};
  }

  // p is not in the face.
  [[nodiscard]] ConstrainedWalkEnd follow_arc(Index f) {
    // p may be opposite to one corner.
    const auto& v = mesh_[f].vertex;
    const bool is_opposite =
        oriented(v[0], v[1], p_) == Sign::zero && oriented(v[0], v[2], p_) == Sign::zero;
    FaceCorner at = {f, is_opposite ? 1U : 0U};
    for (;;) {
      const std::optional<ConstrainedWalkEnd> end = follow_arc_from(at);
      if (end) return *end;
    }
  }

  // Follows the arc from a vertex to p, up to the next vertex on it: then `at` is that, in the face
  // before, and nothing is returned.
  [[nodiscard]] std::optional<ConstrainedWalkEnd> follow_arc_from(FaceCorner& at) {
    const Index q = vertex(at);
    FaceCorner first = at;
    FaceCorner last = at;
    const std::optional<ArcDeparture> departure = find_departure(q, first, last);
    if (!departure) {
      // The arc leaves what solid faces cover at q. Then p is beyond an edge of the border there.
      const topology::Halfedge h =
          topology::halfedge(first.face, topology::previous_corner[first.corner]);
      if (side_of_edge(h) == Sign::negative) return ConstrainedWalkEnd{Where::outside, h};
      return ConstrainedWalkEnd{Where::outside,
                                topology::halfedge(last.face, topology::next_corner[last.corner])};
    }
    const auto [f, corner] = departure->at;
    const topology::Halfedge ahead = topology::halfedge(f, corner);
    const Sign side = side_of_edge(ahead);
    if (departure->step == ArcStep::across) return cross_from(q, ahead, side, at);
    const bool is_next = departure->step == ArcStep::along_next;
    const unsigned end =
        is_next ? topology::next_corner[corner] : topology::previous_corner[corner];
    at = {f, end};
    if (side == Sign::negative) return {};
    if (side == Sign::zero) return ConstrainedWalkEnd{Where::vertex, topology::halfedge(f, end)};
    return ConstrainedWalkEnd{Where::edge,
                              topology::halfedge(f, is_next ? topology::previous_corner[corner]
                                                            : topology::next_corner[corner])};
  }

  // Crosses edges from `h` on, to which the arc from q comes; p is at this side of it.
  [[nodiscard]] std::optional<ConstrainedWalkEnd> cross_from(Index q, topology::Halfedge h,
                                                             Sign side, FaceCorner& at) {
    while (side == Sign::negative) {
      count_step();
      const topology::Halfedge entered = mesh_[topology::face_of(h)].opposite[topology::edge_of(h)];
      const Index f = topology::face_of(entered);
      if (!is_solid(f)) return ConstrainedWalkEnd{Where::outside, h};
      const unsigned apex = topology::edge_of(entered);
      const Sign of_apex = oriented(q, p_, mesh_[f].vertex[apex]);
      // The edges of the face: from its apex to the left, and from the right to its apex.
      h = topology::halfedge(f, of_apex == Sign::negative ? topology::previous_corner[apex]
                                                          : topology::next_corner[apex]);
      side = side_of_edge(h);
      if (of_apex == Sign::zero && side != Sign::positive) {
        at = {f, apex};
        if (side == Sign::negative) return {};
        return ConstrainedWalkEnd{Where::vertex, topology::halfedge(f, apex)};
      }
    }
    return ConstrainedWalkEnd{side == Sign::zero ? Where::edge : Where::face, h};
  }

  // Finds the face by which the arc from q to p leaves q: counterclockwise from `first`, and then
  // clockwise. Without one there are ghost faces at q, and `first` and `last` are beside them.
  [[nodiscard]] std::optional<ArcDeparture> find_departure(Index q, FaceCorner& first,
                                                           FaceCorner& last) {
    for (;;) {
      count_step();
      if (const auto found = departure_by(q, last)) return found;
      const Index next = mesh_.next_around(last.face, last.corner);
      if (!is_solid(topology::face_of(next))) break;
      last = {topology::face_of(next), topology::edge_of(next)};
    }
    for (;;) {
      count_step();
      const Index previous = mesh_.previous_around(first.face, first.corner);
      if (!is_solid(topology::face_of(previous))) return {};
      first = {topology::face_of(previous), topology::edge_of(previous)};
      if (const auto found = departure_by(q, first)) return found;
    }
  }

  [[nodiscard]] std::optional<ArcDeparture> departure_by(Index q, const FaceCorner& at) const {
    const auto& v = mesh_[at.face].vertex;
    const Sign next = oriented(q, p_, v[topology::next_corner[at.corner]]);
    if (next == Sign::positive) return {};
    const Sign previous = oriented(q, p_, v[topology::previous_corner[at.corner]]);
    if (next == Sign::zero && previous == Sign::positive) {
      return ArcDeparture{at, ArcStep::along_next};
    }
    if (next == Sign::zero || previous == Sign::negative) return {};
    return ArcDeparture{at, previous == Sign::zero ? ArcStep::along_previous : ArcStep::across};
  }

  const Oriented& oriented_;
  const topology::Mesh& mesh_;
  const kernel::FaceKinds& kinds_;
  std::span<const std::uint8_t> sides_;
  Index p_;
  std::size_t steps_left_;
};

}  // namespace rondel::constrained
