// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lets a constrained edge be free again: the faces on both sides of it that are no longer Delaunay
// are taken away, and what is between is filled, in time in proportion to their number.
//
//            p ----- q               The corridor along ab is bounded by edges to its left and right.
//          /  \     /  \             A base from u on the left to l on the right moves from a to b
//        a     u   /    b            as in a merge of two triangulations (Guibas, Stolfi, Primitives
//          \   | \ /   /             for the manipulation of general subdivisions, ACM TOG 4, 1985):
//            \ l -- r                faces beside it that see the other end of the base in their
//                                    circle are taken away, and a face from the base to the next
//                                    vertex on one of the two sides is added.
//
// docs/theory/constrained.md, "Constraints that come and go", has the proof.
//
// in    faces, as ArcInsertion asks for them; an edge of two solid faces that is not constrained
// out   the faces in which the edge and all others in its place are locally Delaunay
// index vertices and faces as `Faces` numbers them; halfedges 3 * face + i
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::constrained {

template <class Faces>
class ArcRemoval {
 public:
  // Replaces the edge of a halfedge, one of whose faces has the apex of the other one inside its
  // circle.
  void run(Faces& faces, Index h) {
    const Index o = faces.opposite(h);
    const Triple& face = faces.corners(topology::face_of(h));
    const Index a = face[topology::next_corner[topology::edge_of(h)]];
    const Index b = face[topology::previous_corner[topology::edge_of(h)]];
    taken_.clear();
    made_.clear();
    closed_.clear();
    left_.vertex = a;
    right_.vertex = a;
    left_.edges.assign(1, {o, h, b, false});
    right_.edges.assign(1, {h, o, b, false});
    take(faces, left_);
    take(faces, right_);
    leave_end(faces);
    while (!is_at_end(faces)) {
    }
    fill(faces);
  }

 private:
  // An edge between the corridor and a face beside it.
  struct CorridorEdge {
    Index inner;  // the halfedge in a face that was taken away
    Index outer;  // its opposite
    Index far;    // the end farther from a
    bool is_constrained;
  };
  // The edges on one side of the corridor, those nearest to b first, and the vertex where they begin.
  struct CorridorSide {
    Index vertex;
    std::vector<CorridorEdge> edges;
    [[nodiscard]] const CorridorEdge& next() const { return edges.back(); }
  };
  // A new face, whose edge opposite to corner `base` is the next base; that opposite to corner 2 is
  // the one before.
  struct MadeFace {
    Triple corners;
    unsigned base;
  };
  // An edge of the corridor that has become an edge of a new face.
  struct ClosedEdge {
    CorridorEdge edge;
    std::size_t face;
    unsigned corner;
    bool is_double;  // the face beyond was taken away, too
  };

  // True if the face beyond the next edge may be taken away.
  [[nodiscard]] static bool is_open(const Faces& faces, const CorridorSide& side) {
    const CorridorEdge& edge = side.next();
    const Index beyond = topology::face_of(edge.outer);
    return !edge.is_constrained && faces.is_solid(beyond) && !faces.is_in_cavity(beyond);
  }
  // True if the face beyond the next edge has a vertex inside its circle.
  [[nodiscard]] static bool has_inside(const Faces& faces, const CorridorSide& side, Index v) {
    const Triple& face = faces.corners(topology::face_of(side.next().outer));
    if (face[0] == v || face[1] == v || face[2] == v) return false;
    return faces.is_in_circle(face[0], face[1], face[2], v);
  }
  // True if a vertex is beyond the base.
  [[nodiscard]] bool is_ahead(const Faces& faces, Index v) const {
    return faces.side(left_.vertex, right_.vertex, v) == Sign::positive;
  }

  void take(Faces& faces, CorridorSide& side);
  void leave_end(Faces& faces);
  [[nodiscard]] bool is_at_end(Faces& faces);
  void close(CorridorSide& side, unsigned corner);
  void fill(Faces& faces);

  CorridorSide left_;
  CorridorSide right_;
  std::vector<Index> taken_;  // the faces that were taken away
  std::vector<MadeFace> made_;
  std::vector<ClosedEdge> closed_;
};

// Takes the face beyond the next edge away.
template <class Faces>
void ArcRemoval<Faces>::take(Faces& faces, CorridorSide& side) {
  const CorridorEdge edge = side.next();
  side.edges.pop_back();
  const Index f = topology::face_of(edge.outer);
  const unsigned apex = topology::edge_of(edge.outer);
  faces.put_in_cavity(f);
  taken_.push_back(f);
  const unsigned next = topology::next_corner[apex];
  const unsigned previous = topology::previous_corner[apex];
  const bool is_far = faces.corners(f)[next] == edge.far;
  const auto append = [&](unsigned corner, Index far) {
    const Index inner = topology::halfedge(f, corner);
    side.edges.push_back({inner, faces.opposite(inner), far, faces.is_constrained(inner)});
  };
  append(is_far ? previous : next, edge.far);
  append(is_far ? next : previous, faces.corners(f)[apex]);
}

// Turns the next edges of both sides away from ab until no face beside them has the end of the other
// one inside its circle; they are two sides of the first face then.
template <class Faces>
void ArcRemoval<Faces>::leave_end(Faces& faces) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    while (is_open(faces, left_) && has_inside(faces, left_, right_.next().far)) {
      take(faces, left_);
    }
    while (is_open(faces, right_) && has_inside(faces, right_, left_.next().far)) {
      take(faces, right_);
      has_changed = true;
    }
  }
  const Index a = left_.vertex;
  made_.push_back({{left_.next().far, a, right_.next().far}, 1});
  close(right_, 0);
  close(left_, 2);
}

// Adds the face beyond the base. Returns true if it is the last one.
template <class Faces>
bool ArcRemoval<Faces>::is_at_end(Faces& faces) {
  const Index u = left_.vertex;
  const Index l = right_.vertex;
  while (is_open(faces, left_) && is_ahead(faces, left_.next().far) &&
         has_inside(faces, left_, l)) {
    take(faces, left_);
  }
  while (is_open(faces, right_) && is_ahead(faces, right_.next().far) &&
         has_inside(faces, right_, u)) {
    take(faces, right_);
  }
  const Index p = left_.next().far;
  const Index q = right_.next().far;
  if (p == q) {
    made_.push_back({{u, l, p}, 2});
    close(right_, 0);
    close(left_, 1);
    return true;
  }
  const bool is_right =
      !is_ahead(faces, p) || (is_ahead(faces, q) && faces.is_in_circle(u, l, p, q));
  made_.push_back({{u, l, is_right ? q : p}, is_right ? 1U : 0U});
  close(is_right ? right_ : left_, is_right ? 0 : 1);
  return false;
}

// Lets the next edge of a side be that of the new face opposite to a corner.
template <class Faces>
void ArcRemoval<Faces>::close(CorridorSide& side, unsigned corner) {
  closed_.push_back({side.next(), made_.size() - 1, corner, false});
  side.vertex = side.next().far;
  side.edges.pop_back();
}

// Puts the new faces in the place of those that were taken away, which are as many.
template <class Faces>
void ArcRemoval<Faces>::fill(Faces& faces) {
  assert(made_.size() == taken_.size());
  for (ClosedEdge& closed : closed_) {
    closed.is_double = faces.is_in_cavity(topology::face_of(closed.edge.outer));
  }
  for (std::size_t k = 0; k < made_.size(); ++k) faces.replace(taken_[k], made_[k].corners);
  for (std::size_t k = 0; k + 1 < made_.size(); ++k) {
    faces.link(topology::halfedge(taken_[k], made_[k].base), topology::halfedge(taken_[k + 1], 2));
  }
  // Both faces at an edge may be new, and the edge is none of those that were replaced.
  const auto name = [](const ClosedEdge& closed) {
    return std::min(closed.edge.inner, closed.edge.outer);
  };
  const auto doubles = std::partition(closed_.begin(), closed_.end(),
                                      [](const ClosedEdge& closed) { return !closed.is_double; });
  std::sort(doubles, closed_.end(),
            [&](const ClosedEdge& c, const ClosedEdge& d) { return name(c) < name(d); });
  const auto inside = [this](const ClosedEdge& closed) {
    return topology::halfedge(taken_[closed.face], closed.corner);
  };
  for (auto closed = closed_.begin(); closed != doubles; ++closed) {
    faces.link(inside(*closed), closed->edge.outer);
  }
  for (auto closed = doubles; closed != closed_.end(); closed += 2) {
    faces.link(inside(closed[0]), inside(closed[1]));
  }
  for (const ClosedEdge& closed : closed_) {
    if (closed.edge.is_constrained) faces.constrain_side(inside(closed));
  }
}

}  // namespace rondel::constrained
