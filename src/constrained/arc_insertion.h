// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Inserts an arc between two vertices into faces; docs/theory/constrained.md has the proof.
//
//            left chain                An arc from v to w crosses the edges of the faces of its
//            o----o----o               cavity. They are replaced by triangulations of the two
//          / |  / | \  | \             polygons beside the arc: left of v -> w and left of w -> v.
//        v --+-/--+--\-+-- w           A polygon may touch itself, where an edge has its faces on
//          \ |/   |   \| /             both sides in the cavity.
//            o----o----o
//            right chain
//
// in    the faces (ConstrainedFaces of a build, ConstrainedHull of one that changes), two vertices
// out   the faces that have the arc as a chain of edges
// index vertices and faces as `Faces` numbers them; halfedges 3 * face + i, the edge opposite to
//       corner i
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/link_triangulation.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::constrained {

// How an arc leaves a vertex: along the halfedge, or across it if the vertex is opposite to it.
struct Departure {
  Index halfedge;
  bool is_along;
};

// The solid faces around a vertex, one after the other, counterclockwise and then clockwise from
// the first one.
template <class Faces>
class ArcFan {
 public:
  // The fan of v, of which faces on the arc to `target` are looked for.
  ArcFan(const Faces& all, Index v, Index target)
      : all_(all), v_(v), target_(target), face_(all.solid_face_at(v)), corner_(corner_in(face_)) {
    second_ = side_of(topology::next_corner[corner_]);
    third_ = side_of(topology::previous_corner[corner_]);
    first_ = face_;
    first_second_ = second_;
  }

  // Returns how the arc leaves the vertex if it does so by the current face.
  [[nodiscard]] std::optional<Departure> departure() const {
    const unsigned p = topology::next_corner[corner_];
    const unsigned q = topology::previous_corner[corner_];
    const Triple& face = all_.corners(face_);
    const bool is_along_p =
        face[p] == target_ || (second_ == Sign::zero && third_ == Sign::positive);
    if (is_along_p) return Departure{topology::halfedge(face_, q), true};
    const bool is_along_q =
        face[q] == target_ || (third_ == Sign::zero && second_ == Sign::negative);
    if (is_along_q) return Departure{topology::halfedge(face_, p), true};
    if (second_ == Sign::negative && third_ == Sign::positive) {
      return Departure{topology::halfedge(face_, corner_), false};
    }
    return {};
  }

  // Goes on to the next face. There is one: the arc leaves the vertex by a face of the fan.
  void advance() {
    if (!is_clockwise_) {
      if (turn(topology::next_corner[corner_]) && face_ != first_) {
        second_ = third_;
        third_ = side_of(topology::previous_corner[corner_]);
        return;
      }
      is_clockwise_ = true;
      face_ = first_;
      corner_ = corner_in(face_);
      second_ = first_second_;
    }
    turn(topology::previous_corner[corner_]);
    third_ = second_;
    second_ = side_of(topology::next_corner[corner_]);
  }

 private:
  [[nodiscard]] unsigned corner_in(Index f) const {
    return topology::corner_of(all_.corners(f), v_);
  }
  // Crosses an edge of the face. Returns false if there is a ghost face.
  bool turn(unsigned edge) {
    const Index next = all_.neighbor(face_, edge);
    if (!all_.is_solid(next)) return false;
    face_ = next;
    corner_ = corner_in(next);
    return true;
  }
  [[nodiscard]] Sign side_of(unsigned corner) const {
    const Index p = all_.corners(face_)[corner];
    return p == target_ ? Sign::zero : all_.side(v_, target_, p);
  }

  const Faces& all_;
  Index v_;
  Index target_;
  Index face_;
  unsigned corner_;
  // The sides of the next two corners of the face.
  Sign second_ = Sign::zero;
  Sign third_ = Sign::zero;
  Index first_ = 0;
  Sign first_second_ = Sign::zero;
  bool is_clockwise_ = false;
};

// The template parameter Faces has corners(f), neighbor(f, edge), opposite(h), is_solid(f),
// solid_face_at(v), is_constrained(h), side(a, b, v), is_in_circle(a, b, c, v); and, to change them,
// put_in_cavity(f), is_in_cavity(f), replace(f, corners), which lets a face have no constrained
// side, link(h, g), constrain_side(h) for the face of h alone, constrain(h) for both.
template <class Faces>
class ArcInsertion {
 public:
  using Edge = std::array<Index, 2>;

  // Inserts the arc from a to b, and calls tell(v, w) for each piece of it. If it crosses a
  // constrained edge, some pieces are there, and the edge is returned.
  template <class Tell>
  std::optional<Edge> insert(Faces& faces, Index a, Index b, const Tell& tell) {
    if (const Index edge = edge_between(faces, a, b); edge != no_index) {
      faces.constrain(edge);
      tell(a, b);
      return {};
    }
    while (a != b) {
      const Departure first = departure(faces, a, b);
      Index end = no_index;
      if (first.is_along) {
        end = end_along(faces, a, first.halfedge);
        faces.constrain(first.halfedge);
      } else {
        if (const auto crossed = dig(faces, a, b, first.halfedge)) return crossed;
        end = left_.vertices.back();
        refill(faces);
      }
      tell(a, end);
      a = end;
    }
    return {};
  }

  // Returns a constrained edge that the arc from a to b crosses, if there is one.
  std::optional<Edge> find_crossed(const Faces& faces, Index a, Index b) {
    while (a != b) {
      const Departure first = departure(faces, a, b);
      if (first.is_along) {
        a = end_along(faces, a, first.halfedge);
        continue;
      }
      if (const auto crossed = dig(faces, a, b, first.halfedge)) return crossed;
      a = left_.vertices.back();
    }
    return {};
  }

  // Returns the halfedge of a solid face between two vertices, if it is among the first ones around
  // the vertex a, counterclockwise and then clockwise. Most constraints are edges, which no
  // coordinates are needed to find.
  static Index edge_between(const Faces& faces, Index a, Index b) {
    constexpr unsigned most = 16;  // most vertices have fewer faces
    const Index first = faces.solid_face_at(a);
    unsigned steps = 0;
    for (const bool is_clockwise : {false, true}) {
      Index face = first;
      do {
        const Triple& corners = faces.corners(face);
        const unsigned own = topology::corner_of(corners, a);
        const unsigned next = topology::next_corner[own];
        const unsigned previous = topology::previous_corner[own];
        if (corners[next] == b) return topology::halfedge(face, previous);
        if (corners[previous] == b) return topology::halfedge(face, next);
        face = faces.neighbor(face, is_clockwise ? previous : next);
        if (face == first) return no_index;
      } while (faces.is_solid(face) && ++steps < most);
    }
    return no_index;
  }

  // Finds the first step of the arc from a to b, or of that from b to a, and exchanges the ends in
  // that case. Both are looked for at once, as only one end may have few faces.
  static Departure departure(const Faces& faces, Index& a, Index& b) {
    ArcFan<Faces> fan(faces, a, b);
    ArcFan<Faces> other(faces, b, a);
    while (true) {
      if (const auto found = fan.departure()) return *found;
      if (const auto found = other.departure()) {
        std::swap(a, b);
        return *found;
      }
      fan.advance();
      other.advance();
    }
  }

  // Returns the other end of an edge at a vertex.
  static Index end_along(const Faces& faces, Index v, Index h) {
    const Triple& face = faces.corners(topology::face_of(h));
    const Index from = face[topology::next_corner[topology::edge_of(h)]];
    return from == v ? face[topology::previous_corner[topology::edge_of(h)]] : from;
  }

 private:
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
    Index limit;     // the number of edges up to which it may be triangulated at once
    [[nodiscard]] Index size() const { return last - first; }
  };
  // Parts with so many edges may be triangulated at once.
  static constexpr Index many = 16;

  // Two halfedges of new faces that are opposite to each other if the old one is the same.
  struct DoubleEdge {
    Index old;
    Index halfedge;
  };

  // Appends a vertex, and the edge that leads to it from the vertex before, as the cavity has it.
  static void append(const Faces& faces, Polygon& polygon, Index vertex, Index h) {
    polygon.vertices.push_back(vertex);
    polygon.edges.push_back({h, no_index, false, faces.is_constrained(h)});
  }

  std::optional<Edge> dig(const Faces& faces, Index a, Index b, Index h);
  void refill(Faces& faces);
  void look_outside(const Faces& faces, Polygon& polygon);
  Index fill(Faces& faces, const Polygon& polygon);
  void close(Faces& faces, const PolygonEdge& edge, Index h);
  [[nodiscard]] static Index apex_of(Faces& faces, const Polygon& polygon, Index first, Index last);
  Index add_face(Faces& faces, const Triple& corners);
  [[nodiscard]] bool is_almost_convex(const Faces& faces, const Polygon& polygon,
                                      const SubPolygon& part);
  void take_ring(const Polygon& polygon, const SubPolygon& part);
  [[nodiscard]] bool triangulate_at_once(Faces& faces, bool is_convex);
  Index take_triangulation(Faces& faces, const Polygon& polygon, const SubPolygon& part);

  // All of this belongs to the arc that is inserted.
  std::vector<Index> cavity_;
  Polygon left_;
  Polygon right_;  // from the same end as left_ until it is filled
  std::vector<SubPolygon> to_fill_;
  std::vector<DoubleEdge> double_edges_;
  dynamic::LinkTriangulation triangulation_;
  std::vector<Index> ring_;   // the vertices of a part
  std::vector<Index> slots_;  // the faces that fill it
};

// Finds the cavity of the arc from a, which leaves a face by a halfedge, to the first vertex on it.
// Returns an edge that must not be crossed, if there is one.
template <class Faces>
std::optional<std::array<Index, 2>> ArcInsertion<Faces>::dig(const Faces& faces, Index a, Index b,
                                                             Index h) {
  using topology::edge_of;
  using topology::face_of;
  using topology::halfedge;
  using topology::next_corner;
  using topology::previous_corner;
  cavity_.assign(1, face_of(h));
  left_.clear();
  right_.clear();
  left_.vertices.push_back(a);
  right_.vertices.push_back(a);
  const Triple& first = faces.corners(face_of(h));
  append(faces, right_, first[next_corner[edge_of(h)]],
         halfedge(face_of(h), previous_corner[edge_of(h)]));
  append(faces, left_, first[previous_corner[edge_of(h)]],
         halfedge(face_of(h), next_corner[edge_of(h)]));
  while (true) {
    if (faces.is_constrained(h)) return Edge{right_.vertices.back(), left_.vertices.back()};
    const Index entered = faces.opposite(h);
    const Index face = face_of(entered);
    cavity_.push_back(face);
    // The edges of the face beyond: from its apex to the left, and from the right to its apex.
    const Index at_left = halfedge(face, previous_corner[edge_of(entered)]);
    const Index at_right = halfedge(face, next_corner[edge_of(entered)]);
    const Index apex = faces.corners(face)[edge_of(entered)];
    const Sign s = apex == b ? Sign::zero : faces.side(a, b, apex);
    if (s != Sign::negative) append(faces, left_, apex, at_left);
    if (s != Sign::positive) append(faces, right_, apex, at_right);
    if (s == Sign::zero) return {};
    h = s == Sign::positive ? at_right : at_left;
  }
}

// Replaces the faces of the cavity by those of the two polygons.
template <class Faces>
void ArcInsertion<Faces>::refill(Faces& faces) {
  std::ranges::reverse(right_.vertices);
  std::ranges::reverse(right_.edges);
  for (const Index f : cavity_) faces.put_in_cavity(f);
  look_outside(faces, left_);
  look_outside(faces, right_);
  const Index h = fill(faces, left_);
  faces.link(h, fill(faces, right_));
  faces.constrain(h);
}

// Finds what is beyond the edges of a polygon while the faces of the cavity are as they were.
template <class Faces>
void ArcInsertion<Faces>::look_outside(const Faces& faces, Polygon& polygon) {
  for (PolygonEdge& edge : polygon.edges) {
    edge.outer = faces.opposite(edge.inner);
    edge.is_double = faces.is_in_cavity(topology::face_of(edge.outer));
  }
}

template <class Faces>
Index ArcInsertion<Faces>::add_face(Faces& faces, const Triple& corners) {
  const Index face = cavity_.back();
  cavity_.pop_back();
  faces.replace(face, corners);
  return face;
}

// True if few vertices of the chain of a part are reflex, and none occurs twice. At both ends of the
// base none is reflex.
template <class Faces>
bool ArcInsertion<Faces>::is_almost_convex(const Faces& faces, const Polygon& polygon,
                                           const SubPolygon& part) {
  const std::vector<Index>& chain = polygon.vertices;
  const Index most = part.size() / 8;
  Index num_reflex = 0;
  for (Index i = part.first + 1; i < part.last && num_reflex <= most; ++i) {
    const bool is_left = chain[i - 1] != chain[i + 1] &&
                         faces.side(chain[i + 1], chain[i], chain[i - 1]) == Sign::positive;
    num_reflex += is_left ? 0 : 1;
  }
  if (num_reflex > most) return false;
  ring_.assign(chain.begin() + part.first, chain.begin() + part.last + 1);
  std::ranges::sort(ring_);
  return std::ranges::adjacent_find(ring_) == ring_.end();
}

// Lists the vertices of a part. Edge 0 of the ring is the base; edge e is edge last - e of the polygon.
template <class Faces>
void ArcInsertion<Faces>::take_ring(const Polygon& polygon, const SubPolygon& part) {
  ring_.assign(1, polygon.vertices[part.first]);
  for (Index i = part.last; i > part.first; --i) ring_.push_back(polygon.vertices[i]);
}

// Triangulates the ring in random order (Chew 1990). As if it were convex that takes less time, and the
// result may be wrong if it is not: it is right if all faces are positive and all edges between them are
// locally Delaunay, which is tested. Nothing but triangulation_ changes.
template <class Faces>
bool ArcInsertion<Faces>::triangulate_at_once(Faces& faces, bool is_convex) {
  struct CircleTest {
    Faces& faces;
    [[nodiscard]] bool is_in_conflict(const Triple& face, Index v) const {
      return v != face[0] && v != face[1] && v != face[2] &&
             faces.is_in_circle(face[0], face[1], face[2], v);
    }
  };
  CircleTest test{faces};
  const auto is_corner_convex = [&](Index p, Index u, Index q) {
    return ring_[p] != ring_[q] && faces.side(ring_[p], ring_[u], ring_[q]) == Sign::positive;
  };
  if (is_convex) {
    triangulation_.run(test, ring_);
  } else if (!triangulation_.run_by_ears(test, ring_, is_corner_convex)) {
    return false;
  }
  const auto made = triangulation_.faces();
  for (std::size_t k = 0; k < made.size(); ++k) {
    const auto& v = made[k].vertex;
    const Triple face = {ring_[v[0]], ring_[v[1]], ring_[v[2]]};
    if (faces.side(face[0], face[1], face[2]) != Sign::positive) return false;
    for (const Index other : made[k].opposite) {
      if (other == no_index || topology::face_of(other) < k) continue;
      const Index apex = ring_[made[topology::face_of(other)].vertex[topology::edge_of(other)]];
      if (test.is_in_conflict(face, apex)) return false;
    }
  }
  return true;
}

// Takes the faces of a part that was triangulated at once, and returns the halfedge from its first
// vertex to its last one.
template <class Faces>
Index ArcInsertion<Faces>::take_triangulation(Faces& faces, const Polygon& polygon,
                                              const SubPolygon& part) {
  const auto made = triangulation_.faces();
  slots_.clear();
  for (const topology::Face& face : made) {
    const auto& v = face.vertex;
    slots_.push_back(add_face(faces, {ring_[v[0]], ring_[v[1]], ring_[v[2]]}));
  }
  Index base = no_index;
  for (std::size_t k = 0; k < made.size(); ++k) {
    for (unsigned i = 0; i < 3; ++i) {
      const Index inside = topology::halfedge(slots_[k], i);
      const Index other = made[k].opposite[i];
      const Index edge = made[k].vertex[topology::next_corner[i]];
      if (other != no_index) {
        faces.link(inside,
                   topology::halfedge(slots_[topology::face_of(other)], topology::edge_of(other)));
      } else if (edge == 0) {
        base = inside;
      } else {
        close(faces, polygon.edges[part.last - edge], inside);
      }
    }
  }
  return base;
}

// Returns the vertex of a polygon, by its place in the chain, that makes with the base a face
// without any other vertex of the polygon inside its circle.
template <class Faces>
Index ArcInsertion<Faces>::apex_of(Faces& faces, const Polygon& polygon, Index first, Index last) {
  const std::vector<Index>& chain = polygon.vertices;
  Index apex = first + 1;
  for (Index i = first + 2; i < last; ++i) {
    if (chain[i] == chain[apex]) continue;
    if (faces.is_in_circle(chain[first], chain[last], chain[apex], chain[i])) apex = i;
  }
  return apex;
}

// Links a halfedge of a new face, which is at an edge of the polygon.
template <class Faces>
void ArcInsertion<Faces>::close(Faces& faces, const PolygonEdge& edge, Index h) {
  if (edge.is_double) {
    double_edges_.push_back({std::min(edge.inner, edge.outer), h});
  } else {
    faces.link(h, edge.outer);
  }
  if (edge.is_constrained) faces.constrain_side(h);
}

// Triangulates a polygon, and returns the halfedge from its first vertex to its last one.
template <class Faces>
Index ArcInsertion<Faces>::fill(Faces& faces, const Polygon& polygon) {
  Index base = no_index;
  double_edges_.clear();
  to_fill_.assign(1, {0, static_cast<Index>(polygon.vertices.size() - 1), no_index, no_index});
  while (!to_fill_.empty()) {
    const SubPolygon part = to_fill_.back();
    const auto [first, last, beyond, limit] = part;
    to_fill_.pop_back();
    if (part.size() == 1) {
      close(faces, polygon.edges[first], beyond);
      continue;
    }
    const bool is_tried = part.size() >= many && part.size() <= limit;
    bool is_done = false;
    if (is_tried) {
      const bool is_convex = is_almost_convex(faces, polygon, part);
      take_ring(polygon, part);
      is_done =
          (is_convex && triangulate_at_once(faces, true)) || triangulate_at_once(faces, false);
    }
    Index to_last = no_index;
    if (is_done) {
      to_last = take_triangulation(faces, polygon, part);
    } else {
      const Index apex = apex_of(faces, polygon, first, last);
      const std::vector<Index>& chain = polygon.vertices;
      const Index face = add_face(faces, {chain[first], chain[last], chain[apex]});
      // After a failure only parts of half the size are worth another one.
      const Index next_limit = is_tried ? part.size() / 2 : limit;
      to_fill_.push_back({first, apex, topology::halfedge(face, 1), next_limit});
      to_fill_.push_back({apex, last, topology::halfedge(face, 0), next_limit});
      to_last = topology::halfedge(face, 2);
    }
    if (beyond == no_index) {
      base = to_last;
    } else {
      faces.link(to_last, beyond);
    }
  }
  std::ranges::sort(double_edges_, {}, &DoubleEdge::old);
  for (std::size_t i = 1; i < double_edges_.size(); i += 2) {
    faces.link(double_edges_[i - 1].halfedge, double_edges_[i].halfedge);
  }
  return base;
}

}  // namespace rondel::constrained
