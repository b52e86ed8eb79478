// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/refined_faces.h"

#include <algorithm>
#include <utility>

#include "predicates/conflict.h"
#include "predicates/orientation.h"
#include "rondel/predicates.h"

namespace rondel::mesh {

using topology::edge_of;
using topology::face_of;
using topology::halfedge;

RefinedFaces::RefinedFaces(const ConstrainedTriangulation& given, std::span<const Index> region) {
  const Triangulation& triangulation = given.triangulation;
  const std::span<const Point> sites = triangulation.sites().points();
  points_.assign(sites.begin(), sites.end());
  directions_.resize(sites.size());
  predicates::directions(sites, {}, directions_.data());
  kinds_.assign(sites.size(), VertexKind::given);
  const std::span<const Triple> corners = triangulation.faces();
  const std::span<const Triple> neighbors = triangulation.neighbors();
  std::vector<Index> number(corners.size(), no_index);
  for (Index f = 0; f < corners.size(); ++f) {
    if (triangulation.is_ghost(f)) continue;
    number[f] = static_cast<Index>(faces_.size());
    faces_.push_back(
        {corners[f], {no_index, no_index, no_index}, {no_index, no_index, no_index}, region[f]});
  }
  for (Index e = 0; e < given.edges.size(); ++e) segments_.push_back({e, no_index});
  for (Index f = 0; f < corners.size(); ++f) {
    if (number[f] == no_index) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const Index a = corners[f][topology::next_corner[i]];
      const Index b = corners[f][topology::previous_corner[i]];
      const Index g = neighbors[f][i];
      if (number[g] != no_index) {
        unsigned j = 0;
        while (corners[g][topology::next_corner[j]] != b ||
               corners[g][topology::previous_corner[j]] != a)
          ++j;
        faces_[number[f]].opposite[i] = halfedge(number[g], j);
      }
      Index& segment = faces_[number[f]].segment[i];
      if (segment != no_index) continue;
      if ((given.sides[f] >> i & 1U) != 0) {
        const std::array<Index, 2> ends = {std::min(a, b), std::max(a, b)};
        segment =
            static_cast<Index>(std::ranges::lower_bound(given.edges, ends) - given.edges.begin());
      } else if (number[g] == no_index || region[f] != region[g]) {
        segment = static_cast<Index>(segments_.size());
        segments_.push_back({no_index, no_index});
      }
      if (segment == no_index || number[g] == no_index) continue;
      const Index other = faces_[number[f]].opposite[i];
      faces_[face_of(other)].segment[edge_of(other)] = segment;
    }
  }
}

Index RefinedFaces::from(Index h) const {
  return faces_[face_of(h)].vertex[topology::next_corner[edge_of(h)]];
}

Index RefinedFaces::to(Index h) const {
  return faces_[face_of(h)].vertex[topology::previous_corner[edge_of(h)]];
}

Index RefinedFaces::apex(Index h) const { return faces_[face_of(h)].vertex[edge_of(h)]; }

// On which side of the great circle from a to b a vertex is: positive on the left.
Sign RefinedFaces::side(Index a, Index b, Index v) const {
  const Sign sign = predicates::sure_orientation(directions_[a], directions_[b], directions_[v]);
  return sign != Sign::zero ? sign : orientation(points_[a], points_[b], points_[v]);
}

// On which side of a halfedge a unit vector is: positive on the side of its face.
Sign RefinedFaces::side(const predicates::Vector& p, Index h) const {
  const Index a = from(h);
  const Index b = to(h);
  const Sign sign = predicates::sure_orientation(directions_[a], directions_[b], p);
  return sign != Sign::zero ? sign : orientation(points_[a], points_[b], exact::to_point(p));
}

bool RefinedFaces::is_in_circle(const Triple& face, Index v) const {
  const Sign sign = predicates::sure_side_of_circle(directions_[face[0]], directions_[face[1]],
                                                    directions_[face[2]], directions_[v]);
  if (sign != Sign::zero) return sign == Sign::positive;
  return is_in_conflict(points_[face[0]], points_[face[1]], points_[face[2]], points_[v]);
}

std::optional<RefinedFaces::WalkEnd> RefinedFaces::locate(Index face,
                                                          const predicates::Vector& point) const {
  unsigned i = 0;
  while (i < 3 && side(point, halfedge(face, i)) != Sign::negative) ++i;
  if (i == 3) return WalkEnd{face, no_index};
  // The straight way begins at the corner opposite to the edge beyond which the point is.
  const Index start = faces_[face].vertex[i];
  Index h = halfedge(face, i);
  for (std::size_t steps = 0; steps < faces_.size(); ++steps) {
    const RefinedFace& left = faces_[face_of(h)];
    if (left.segment[edge_of(h)] != no_index) return WalkEnd{face_of(h), h};
    const Index entered = left.opposite[edge_of(h)];
    const Index next = face_of(entered);
    const Index middle = apex(entered);
    Sign turn = predicates::sure_orientation(directions_[start], point, directions_[middle]);
    if (turn == Sign::zero) {
      turn = orientation(points_[start], exact::to_point(point), points_[middle]);
    }
    // If the apex is on the left of the way, it leaves between it and the end on the right.
    h = halfedge(next, turn == Sign::positive ? topology::next_corner[edge_of(entered)]
                                              : topology::previous_corner[edge_of(entered)]);
    if (side(point, h) != Sign::negative) return WalkEnd{next, no_index};
  }
  return {};
}

Index RefinedFaces::add_vertex(const predicates::Vector& point, VertexKind kind) {
  points_.push_back(exact::to_point(point));
  directions_.push_back(point);
  kinds_.push_back(kind);
  return static_cast<Index>(points_.size() - 1);
}

Index RefinedFaces::add_face() {
  if (free_faces_.empty()) {
    faces_.emplace_back();
    return static_cast<Index>(faces_.size() - 1);
  }
  const Index f = free_faces_.back();
  free_faces_.pop_back();
  return f;
}

void RefinedFaces::link(Index h, Index g) {
  faces_[face_of(h)].opposite[edge_of(h)] = g;
  faces_[face_of(g)].opposite[edge_of(g)] = h;
}

std::optional<Index> RefinedFaces::insert(Index face, const predicates::Vector& point) {
  std::array<Sign, 3> sides{};
  int zeros = 0;
  unsigned on = 0;
  for (unsigned i = 0; i < 3; ++i) {
    sides[i] = side(point, halfedge(face, i));
    if (sides[i] == Sign::negative) return {};
    if (sides[i] == Sign::zero) {
      ++zeros;
      on = i;
    }
  }
  if (zeros > 1 || (zeros == 1 && faces_[face].segment[on] != no_index)) return {};
  changed_.clear();
  const Index v = add_vertex(point, VertexKind::free);
  if (zeros == 1) {
    divide_faces(halfedge(face, on), v);
    legalize(false);
    return v;
  }
  const RefinedFace old = faces_[face];
  const std::array<Index, 3> parts = {face, add_face(), add_face()};
  for (unsigned i = 0; i < 3; ++i) {
    // The part at the edge opposite to corner i has the new vertex in its place.
    RefinedFace& part = faces_[parts[i]];
    part = old;
    part.vertex[i] = v;
    for (const unsigned j : {topology::next_corner[i], topology::previous_corner[i]}) {
      part.opposite[j] = halfedge(parts[j], i);
      part.segment[j] = no_index;
    }
    if (old.opposite[i] != no_index) link(halfedge(parts[i], i), old.opposite[i]);
    to_test_.push_back(halfedge(parts[i], i));
    changed_.push_back(parts[i]);
  }
  legalize(true);
  return v;
}

// Divides the faces on both sides of an edge by a vertex on it. The halves of the edge have its
// segment.
void RefinedFaces::divide_faces(Index h, Index v) {
  const Index g = faces_[face_of(h)].opposite[edge_of(h)];
  // The face abc with the edge ab becomes avc and vbc.
  const auto halve = [&](Index edge) {
    const Index f = face_of(edge);
    const unsigned i = edge_of(edge);
    const RefinedFace old = faces_[f];
    const Index other = add_face();
    faces_[other] = old;
    faces_[f].vertex[topology::previous_corner[i]] = v;
    faces_[other].vertex[topology::next_corner[i]] = v;
    const unsigned of_b = topology::next_corner[i];  // the edge opposite to a, from b to c
    faces_[f].segment[of_b] = no_index;
    faces_[other].segment[topology::previous_corner[i]] = no_index;
    link(halfedge(f, of_b), halfedge(other, topology::previous_corner[i]));
    if (old.opposite[of_b] != no_index) link(halfedge(other, of_b), old.opposite[of_b]);
    for (const Index part : {f, other}) {
      changed_.push_back(part);
      for (unsigned j = 0; j < 3; ++j) to_test_.push_back(halfedge(part, j));
    }
    return halfedge(other, i);
  };
  const Index second = halve(h);
  if (g == no_index) return;
  const Index second_beyond = halve(g);
  link(h, second_beyond);
  link(second, g);
}

bool RefinedFaces::fits(const predicates::Vector& point, Index h) const {
  return side(point, halfedge(face_of(h), topology::next_corner[edge_of(h)])) == Sign::positive &&
         side(point, halfedge(face_of(h), topology::previous_corner[edge_of(h)])) == Sign::positive;
}

// Returns the point, or the nearest one that is found to the left of a halfedge, or on it.
std::optional<predicates::Vector> RefinedFaces::moved_inside(const predicates::Vector& point,
                                                             Index h) const {
  const predicates::Vector normal =
      exact::normalized(cross(directions_[from(h)], directions_[to(h)]));
  constexpr double longest_step = 0x1p-48;
  for (double step = 0; step <= longest_step; step = std::max(2 * step, 0x1p-53)) {
    const predicates::Vector place = exact::normalized(point + step * normal);
    if (side(place, h) != Sign::negative && fits(place, h)) return place;
  }
  return {};
}

std::optional<Index> RefinedFaces::divide(Index h, const predicates::Vector& point,
                                          const std::array<Index, 2>& shells) {
  predicates::Vector place = point;
  if (!fits(place, h)) return {};
  const Index g = faces_[face_of(h)].opposite[edge_of(h)];
  const Index old = faces_[face_of(h)].segment[edge_of(h)];
  if (segments_[old].is_cut_off) {
    const auto inside = moved_inside(point, h);
    if (!inside) return {};
    place = *inside;
  } else if (g != no_index && !fits(place, g)) {
    // Beside segments that are nearly one arc a face may be narrower than the rounding of the point.
    // Where nobody asks for it, it is cut off, and what is asked for becomes smaller, never larger.
    const auto inside = moved_inside(point, h);
    if (faces_[face_of(g)].region != no_index || !inside) return {};
    place = *inside;
    faces_[face_of(h)].opposite[edge_of(h)] = no_index;
    faces_[face_of(g)].opposite[edge_of(g)] = no_index;
    faces_[face_of(g)].segment[edge_of(g)] = static_cast<Index>(segments_.size());
    segments_.push_back({no_index, no_index});
    segments_[old].is_cut_off = true;
  }
  changed_.clear();
  const Index v = add_vertex(place, VertexKind::on_segment);
  const Index added = static_cast<Index>(segments_.size());
  segments_.push_back({segments_[old].source, shells[1], segments_[old].is_cut_off});
  segments_[old].shell = shells[0];
  const Index end = to(h);
  divide_faces(h, v);
  // The half at the end of the halfedge is in the faces that were added.
  for (const Index f : changed_) {
    for (unsigned i = 0; i < 3; ++i) {
      const Index e = halfedge(f, i);
      const bool is_second = faces_[f].segment[i] == old &&
                             ((from(e) == v && to(e) == end) || (from(e) == end && to(e) == v));
      if (is_second) faces_[f].segment[i] = added;
    }
  }
  legalize(false);
  return v;
}

// Replaces the edge of a halfedge, between two faces, by the other diagonal.
void RefinedFaces::flip(Index h) {
  const Index g = faces_[face_of(h)].opposite[edge_of(h)];
  const Index f = face_of(h);
  const Index k = face_of(g);
  const unsigned i = edge_of(h);
  const unsigned j = edge_of(g);
  // abc with the edge ab, and bad with ba, become adc and dbc.
  RefinedFace& left = faces_[f];
  RefinedFace& right = faces_[k];
  const Index c = left.vertex[i];
  const Index d = right.vertex[j];
  const unsigned bc = topology::next_corner[i];
  const unsigned ad = topology::next_corner[j];
  const Index beyond_bc = left.opposite[bc];
  const Index beyond_ad = right.opposite[ad];
  const Index segment_bc = left.segment[bc];
  const Index segment_ad = right.segment[ad];
  left.vertex[topology::previous_corner[i]] = d;   // b becomes d
  right.vertex[topology::previous_corner[j]] = c;  // a becomes c
  left.segment[i] = segment_ad;
  right.segment[j] = segment_bc;
  left.segment[bc] = no_index;
  right.segment[ad] = no_index;
  left.opposite[i] = no_index;
  right.opposite[j] = no_index;
  if (beyond_ad != no_index) link(halfedge(f, i), beyond_ad);
  if (beyond_bc != no_index) link(halfedge(k, j), beyond_bc);
  link(halfedge(f, bc), halfedge(k, ad));
}

// Flips free edges until each is locally Delaunay. In a star all edges that may not be are opposite
// to one vertex, and remain so.
void RefinedFaces::legalize(bool is_star) {
  while (!to_test_.empty()) {
    const Index h = to_test_.back();
    to_test_.pop_back();
    const Index f = face_of(h);
    const unsigned i = edge_of(h);
    if (faces_[f].segment[i] != no_index || faces_[f].opposite[i] == no_index) continue;
    const Index g = faces_[f].opposite[i];
    if (!is_in_circle(faces_[f].vertex, apex(g))) continue;
    flip(h);
    const Index k = face_of(g);
    changed_.push_back(f);
    changed_.push_back(k);
    to_test_.push_back(halfedge(f, i));
    to_test_.push_back(halfedge(k, topology::previous_corner[edge_of(g)]));
    if (is_star) continue;
    to_test_.push_back(halfedge(f, topology::previous_corner[i]));
    to_test_.push_back(halfedge(k, edge_of(g)));
  }
}

void RefinedFaces::remove(Index vertex, Index face) {
  changed_.clear();
  const auto corner = [&](Index f) {
    unsigned i = 0;
    while (faces_[f].vertex[i] != vertex) ++i;
    return i;
  };
  // Flips leave the vertex with three neighbors.
  Index f = face;
  std::size_t degree = 0;
  do {
    f = face_of(faces_[f].opposite[topology::next_corner[corner(f)]]);
    ++degree;
  } while (f != face);
  while (degree > 3) {
    // The edge from the vertex to y, between the faces vxy and vyz, may go if xyz is positive, and
    // the vertex is not right of xz.
    const unsigned i = corner(f);
    const Index edge = halfedge(f, topology::next_corner[i]);  // from y to the vertex
    const Index beyond = face_of(faces_[f].opposite[topology::next_corner[i]]);
    const Index x = faces_[f].vertex[topology::next_corner[i]];
    const Index y = faces_[f].vertex[topology::previous_corner[i]];
    const Index z = faces_[beyond].vertex[topology::previous_corner[corner(beyond)]];
    const bool is_ear = side(x, y, z) == Sign::positive && side(x, z, vertex) != Sign::negative;
    if (!is_ear) {
      f = beyond;
      continue;
    }
    flip(edge);
    --degree;
    const bool is_inside = std::ranges::find(faces_[f].vertex, vertex) != faces_[f].vertex.end();
    const Index outside = is_inside ? beyond : f;
    changed_.push_back(outside);
    for (unsigned j = 0; j < 3; ++j) to_test_.push_back(halfedge(outside, j));
    if (outside == f) f = beyond;
  }
  // The last three faces, vxy, g = vyz and k = vzx, become one.
  const unsigned i = corner(f);
  const Index g = face_of(faces_[f].opposite[topology::next_corner[i]]);
  const Index k = face_of(faces_[f].opposite[topology::previous_corner[i]]);
  const RefinedFace of_g = faces_[g];
  const RefinedFace of_k = faces_[k];
  const unsigned at_g = corner(g);
  faces_[f].vertex[i] = of_g.vertex[topology::previous_corner[at_g]];
  const auto take = [&](unsigned j, const RefinedFace& other, unsigned at) {
    faces_[f].segment[j] = other.segment[at];
    faces_[f].opposite[j] = no_index;
    if (other.opposite[at] != no_index) link(halfedge(f, j), other.opposite[at]);
  };
  take(topology::next_corner[i], of_g, at_g);
  take(topology::previous_corner[i], of_k, corner(k));
  for (const Index gone : {g, k}) {
    faces_[gone].vertex = {no_index, no_index, no_index};
    free_faces_.push_back(gone);
  }
  changed_.push_back(f);
  for (unsigned j = 0; j < 3; ++j) to_test_.push_back(halfedge(f, j));
  legalize(false);
}

}  // namespace rondel::mesh
