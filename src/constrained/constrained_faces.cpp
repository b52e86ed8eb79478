// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constrained_faces.h"

#include <algorithm>
#include <array>
#include <utility>

#include "order/renamed.h"
#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "rondel/predicates.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::constrained {

using topology::edge_of;
using topology::face_of;
using topology::halfedge;
using topology::next_corner;
using topology::previous_corner;

class ConstrainedFaces::Fan {
 public:
  // The fan of v, of which faces on the arc to `target` are looked for.
  Fan(const ConstrainedFaces& all, Index v, Index target)
      : all_(all), v_(v), target_(target), face_(all.face_at_[v]), corner_(corner_in(face_)) {
    second_ = side_of(next_corner[corner_]);
    third_ = side_of(previous_corner[corner_]);
    first_ = face_;
    first_second_ = second_;
  }

  // Returns how the arc leaves the vertex if it does so by the current face.
  [[nodiscard]] std::optional<Departure> departure() const {
    const unsigned p = next_corner[corner_];
    const unsigned q = previous_corner[corner_];
    const Triple& face = all_.faces_[face_];
    const bool is_along_p =
        face[p] == target_ || (second_ == Sign::zero && third_ == Sign::positive);
    if (is_along_p) return Departure{halfedge(face_, q), true};
    const bool is_along_q =
        face[q] == target_ || (third_ == Sign::zero && second_ == Sign::negative);
    if (is_along_q) return Departure{halfedge(face_, p), true};
    if (second_ == Sign::negative && third_ == Sign::positive) {
      return Departure{halfedge(face_, corner_), false};
    }
    return {};
  }

  // Goes on to the next face. There is one: the arc leaves the vertex by a face of the fan.
  void advance() {
    if (!is_clockwise_) {
      if (turn(next_corner[corner_]) && face_ != first_) {
        second_ = third_;
        third_ = side_of(previous_corner[corner_]);
        return;
      }
      is_clockwise_ = true;
      face_ = first_;
      corner_ = corner_in(face_);
      second_ = first_second_;
    }
    turn(previous_corner[corner_]);
    third_ = second_;
    second_ = side_of(next_corner[corner_]);
  }

 private:
  [[nodiscard]] unsigned corner_in(Index f) const {
    const Triple& face = all_.faces_[f];
    return face[0] == v_ ? 0 : face[1] == v_ ? 1 : 2;
  }
  // Crosses an edge of the face. Returns false if there is a ghost face.
  bool turn(unsigned edge) {
    const Index next = all_.neighbors_[face_][edge];
    if (!all_.is_solid(next)) return false;
    face_ = next;
    corner_ = corner_in(next);
    return true;
  }
  [[nodiscard]] Sign side_of(unsigned corner) const {
    const Index p = all_.faces_[face_][corner];
    return p == target_ ? Sign::zero : all_.side(v_, target_, p);
  }

  const ConstrainedFaces& all_;
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

ConstrainedFaces::ConstrainedFaces(std::span<const Point> sites, api::Parts& built,
                                   const Sphere& sphere, unsigned threads)
    : sphere_(sphere),
      sites_(sites),
      order_(std::move(built.order)),
      names_(order_),
      faces_(std::move(built.arrays.faces)),
      neighbors_(std::move(built.arrays.neighbors)),
      sides_(faces_.size()),
      states_(faces_.size()),
      is_touched_(order_.size()) {
  for (const Index f : built.arrays.ghost_faces) states_[f] = ghost;
  order::rename(names_, built.renamed);
  number_vertices(threads);
  rename_corners(threads, vertices_);
  face_at_.resize(names_.size());
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!is_solid(f)) continue;
    for (const Index v : faces_[f]) face_at_[v] = f;
  }
}

void ConstrainedFaces::number_vertices(unsigned threads) {
  vertices_.resize(sites_.size());
  directions_.resize(names_.size());
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, names_.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::array<Point, grain> points;
    for (std::size_t v = begin; v < end; ++v) {
      if (v + system::prefetch_distance < end) {
        system::prefetch_to_write(&vertices_[names_[v + system::prefetch_distance]]);
        system::prefetch(&sites_[order_[v + system::prefetch_distance]]);
      }
      vertices_[names_[v]] = static_cast<Index>(v);
      points[v - begin] = sites_[order_[v]];
    }
    predicates::directions(std::span(points).first(end - begin), sphere_.center,
                           &directions_[begin]);
  });
}

// Replaces the corners of all faces.
void ConstrainedFaces::rename_corners(unsigned threads, std::span<const Index> names) {
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, faces_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (f + system::prefetch_distance < end) {
        for (const Index name : faces_[f + system::prefetch_distance]) {
          system::prefetch(&names[name]);
        }
      }
      for (Index& corner : faces_[f]) corner = names[corner];
    }
  });
}

void ConstrainedFaces::start_with_owners() {
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!is_changed(f)) continue;
    const unsigned first = topology::first_corner(faces_[f]);
    const Triple face = faces_[f];
    const Triple neighbors = neighbors_[f];
    unsigned corner = first;
    for (unsigned i = 0; i < 3; ++i) {
      faces_[f][i] = face[corner];
      neighbors_[f][i] = neighbors[corner];
      corner = next_corner[corner];
    }
    const auto bits = static_cast<unsigned>(sides_[f]);
    sides_[f] = static_cast<std::uint8_t>((bits >> first | bits << (3 - first)) & 7U);
    is_touched_[faces_[f][0]] = 1;
  }
}

void ConstrainedFaces::give_back(TriangulationArrays& arrays) {
  rename_corners(1, names_);
  arrays.faces = std::move(faces_);
  arrays.neighbors = std::move(neighbors_);
}

// On which side of the great circle from a to b a vertex is: positive on the left.
Sign ConstrainedFaces::side(Index a, Index b, Index v) const {
  const Sign sign = predicates::sure_orientation(directions_[a], directions_[b], directions_[v]);
  if (sign != Sign::zero) return sign;
  return orientation(point(a), point(b), point(v), sphere_);
}

// True if a vertex is inside the circle of three others.
bool ConstrainedFaces::is_in_circle(Index a, Index b, Index c, Index v) const {
  const Sign sign = predicates::sure_side_of_circle(directions_[a], directions_[b], directions_[c],
                                                    directions_[v]);
  if (sign != Sign::zero) return sign == Sign::positive;
  return is_in_conflict(point(a), point(b), point(c), point(v), Model::projected, sphere_);
}

Index ConstrainedFaces::opposite(Index h) const {
  const Triple& face = faces_[face_of(h)];
  const Index from = face[next_corner[edge_of(h)]];
  const Index to = face[previous_corner[edge_of(h)]];
  const Index g = neighbors_[face_of(h)][edge_of(h)];
  unsigned j = 0;
  while (faces_[g][next_corner[j]] != to || faces_[g][previous_corner[j]] != from) ++j;
  return halfedge(g, j);
}

void ConstrainedFaces::link(Index h, Index g) {
  neighbors_[face_of(h)][edge_of(h)] = face_of(g);
  neighbors_[face_of(g)][edge_of(g)] = face_of(h);
}

void ConstrainedFaces::constrain(Index h) {
  const Index g = opposite(h);
  sides_[face_of(h)] = static_cast<std::uint8_t>(sides_[face_of(h)] | 1U << edge_of(h));
  sides_[face_of(g)] = static_cast<std::uint8_t>(sides_[face_of(g)] | 1U << edge_of(g));
}

// Finds the first step of the arc from a to b, or of that from b to a, and exchanges the ends in
// that case. Both are looked for at once, as only one end may have few faces.
ConstrainedFaces::Departure ConstrainedFaces::departure(Index& a, Index& b) const {
  Fan fan(*this, a, b);
  Fan other(*this, b, a);
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

std::optional<std::array<Index, 2>> ConstrainedFaces::insert(
    const ConstrainedPiece& arc, std::vector<ConstrainedPiece>& pieces) {
  Index a = arc.low;
  Index b = arc.high;
  while (a != b) {
    const Departure first = departure(a, b);
    Index end = no_index;
    if (first.is_along) {
      const Triple& face = faces_[face_of(first.halfedge)];
      const Index from = face[next_corner[edge_of(first.halfedge)]];
      end = from == a ? face[previous_corner[edge_of(first.halfedge)]] : from;
      constrain(first.halfedge);
    } else {
      if (const auto crossed = dig(a, b, first.halfedge)) {
        return std::array{names_[(*crossed)[0]], names_[(*crossed)[1]]};
      }
      end = left_.vertices.back();
      refill();
    }
    pieces.push_back(piece_between(names_[a], names_[end], arc.constraint));
    a = end;
  }
  return {};
}

// Appends a vertex, and the edge that leads to it from the vertex before, as the cavity has it.
void ConstrainedFaces::append(Polygon& polygon, Index vertex, Index h) {
  polygon.vertices.push_back(vertex);
  polygon.edges.push_back({h, no_index, false, is_constrained(h)});
}

// Finds the cavity of the arc from a, which leaves a face by a halfedge, to the first vertex on it.
// Returns an edge that must not be crossed, if there is one.
std::optional<std::array<Index, 2>> ConstrainedFaces::dig(Index a, Index b, Index h) {
  cavity_.assign(1, face_of(h));
  left_.clear();
  right_.clear();
  left_.vertices.push_back(a);
  right_.vertices.push_back(a);
  const Triple& first = faces_[face_of(h)];
  append(right_, first[next_corner[edge_of(h)]], halfedge(face_of(h), previous_corner[edge_of(h)]));
  append(left_, first[previous_corner[edge_of(h)]], halfedge(face_of(h), next_corner[edge_of(h)]));
  while (true) {
    if (is_constrained(h)) {
      return std::array{right_.vertices.back(), left_.vertices.back()};
    }
    const Index entered = opposite(h);
    const Index face = face_of(entered);
    cavity_.push_back(face);
    // The edges of the face beyond: from its apex to the left, and from the right to its apex.
    const Index at_left = halfedge(face, previous_corner[edge_of(entered)]);
    const Index at_right = halfedge(face, next_corner[edge_of(entered)]);
    const Index apex = faces_[face][edge_of(entered)];
    const Sign s = apex == b ? Sign::zero : side(a, b, apex);
    if (s != Sign::negative) append(left_, apex, at_left);
    if (s != Sign::positive) append(right_, apex, at_right);
    if (s == Sign::zero) return {};
    h = s == Sign::positive ? at_right : at_left;
  }
}

// Replaces the faces of the cavity by those of the two polygons.
void ConstrainedFaces::refill() {
  has_changes_ = true;
  std::ranges::reverse(right_.vertices);
  std::ranges::reverse(right_.edges);
  for (const Index f : cavity_) {
    if (!is_changed(f)) is_touched_[faces_[f][0]] = 1;
    states_[f] |= in_cavity;
  }
  look_outside(left_);
  look_outside(right_);
  for (const Index f : cavity_) states_[f] = changed;
  const Index h = fill(left_);
  link(h, fill(right_));
  constrain(h);
}

// Finds what is beyond the edges of a polygon while the faces of the cavity are as they were.
void ConstrainedFaces::look_outside(Polygon& polygon) {
  for (PolygonEdge& edge : polygon.edges) {
    edge.outer = opposite(edge.inner);
    edge.is_double = (states_[face_of(edge.outer)] & in_cavity) != 0;
  }
}

Index ConstrainedFaces::add_face(Index a, Index b, Index c) {
  const Index face = cavity_.back();
  cavity_.pop_back();
  faces_[face] = {a, b, c};
  sides_[face] = 0;
  for (const Index v : {a, b, c}) face_at_[v] = face;
  return face;
}

// Returns the vertex of a polygon, by its place in the chain, that makes with the base a face
// without any other vertex of the polygon inside its circle.
Index ConstrainedFaces::apex_of(const Polygon& polygon, Index first, Index last) const {
  const std::vector<Index>& chain = polygon.vertices;
  Index apex = first + 1;
  for (Index i = first + 2; i < last; ++i) {
    if (chain[i] == chain[apex]) continue;
    if (is_in_circle(chain[first], chain[last], chain[apex], chain[i])) apex = i;
  }
  return apex;
}

// Links a halfedge of a new face, which is at an edge of the polygon.
void ConstrainedFaces::close(const PolygonEdge& edge, Index h) {
  if (edge.is_double) {
    double_edges_.push_back({std::min(edge.inner, edge.outer), h});
  } else {
    link(h, edge.outer);
  }
  if (!edge.is_constrained) return;
  sides_[face_of(h)] = static_cast<std::uint8_t>(sides_[face_of(h)] | 1U << edge_of(h));
}

// Triangulates a polygon, and returns the halfedge from its first vertex to its last one.
Index ConstrainedFaces::fill(const Polygon& polygon) {
  Index base = no_index;
  double_edges_.clear();
  to_fill_.assign(1, {0, static_cast<Index>(polygon.vertices.size() - 1), no_index});
  while (!to_fill_.empty()) {
    const auto [first, last, beyond] = to_fill_.back();
    to_fill_.pop_back();
    if (last == first + 1) {
      close(polygon.edges[first], beyond);
      continue;
    }
    const Index apex = apex_of(polygon, first, last);
    const Index face =
        add_face(polygon.vertices[first], polygon.vertices[last], polygon.vertices[apex]);
    if (beyond == no_index) {
      base = halfedge(face, 2);
    } else {
      link(halfedge(face, 2), beyond);
    }
    to_fill_.push_back({first, apex, halfedge(face, 1)});
    to_fill_.push_back({apex, last, halfedge(face, 0)});
  }
  std::ranges::sort(double_edges_, {}, &DoubleEdge::old);
  for (std::size_t i = 1; i < double_edges_.size(); i += 2) {
    link(double_edges_[i - 1].halfedge, double_edges_[i].halfedge);
  }
  return base;
}

}  // namespace rondel::constrained
