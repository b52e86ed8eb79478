// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Insertion of a place p: the faces go whose circles have p inside and that see it across no
// constraint, and the star of p takes their place (docs/theory/constrained.md, "Insertion of a
// site").
//
//     b_k ---- ... ---- a_1       Outside of what solid faces cover, p sees edges of the border,
//      \   faces seen   /         from a_1 to b_k. The horizon has those of solid faces from b_k
//       \              /          to a_1, and those of ghost faces from a_1 to b_k.
//        `----- p ----'

#include <algorithm>
#include <cassert>

#include "constrained/constrained_hull.h"
#include "constrained/constrained_walk.h"

namespace rondel::constrained {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::next_corner;
using topology::previous_corner;

void ConstrainedHull::insert(Index p, Index close) {
  const auto oriented = [this](Index a, Index b, Index c) { return side(a, b, c); };
  ConstrainedWalk walk(oriented, mesh_, kinds_, sides_, p);
  const bool is_close = close != no_index && is_vertex(close);
  const ConstrainedWalkEnd end = walk.locate(is_close ? solid_face_at(close) : solid_face_);
  assert(end.where != Where::vertex);
  region_.clear();
  horizon_.clear();
  const bool is_on_edge = end.where == Where::edge;
  const bool is_dividing = is_on_edge && is_constrained(end.halfedge);
  const Edge edge = ends_of(end.halfedge);
  forced_ = is_on_edge ? opposite(end.halfedge) : no_index;
  if (end.where == Where::outside) {
    reach_out(p, end.halfedge);
  } else {
    surround(p, face_of(end.halfedge));
  }
  make_star(p);
  if (is_dividing) divide(p, edge);
  if (!lifted_.empty()) restore_lifted(p);
}

// The first face has p.
void ConstrainedHull::surround(Index p, Index f) {
  region_.push_back(f);
  const topology::Face& face = mesh_[f];
  stack_.clear();
  for (unsigned i = 3; i-- > 0;) stack_.push_back({face.vertex[next_corner[i]], face.opposite[i]});
  spread(p);
}

// True if p is strictly beyond an edge of the border, given in its solid face.
bool ConstrainedHull::is_seen(Index p, Halfedge h) const {
  const auto [a, b] = ends_of(h);
  return side(a, b, p) == Sign::negative;
}

// Edges of the border are given in their solid faces; they are looked for in ghost faces.
Halfedge ConstrainedHull::next_on_border(Halfedge h) const {
  Halfedge g = opposite(h);
  do {
    g = opposite(halfedge(face_of(g), previous_corner[edge_of(g)]));
  } while (!is_solid(face_of(g)));
  return g;
}

Halfedge ConstrainedHull::previous_on_border(Halfedge h) const {
  Halfedge g = opposite(h);
  do {
    g = opposite(halfedge(face_of(g), next_corner[edge_of(g)]));
  } while (!is_solid(face_of(g)));
  return g;
}

// Lists the edges of the border that p sees: they follow each other, and may be all of it.
void ConstrainedHull::list_seen_border(Index p, Halfedge visible) {
  Halfedge first = visible;
  for (;;) {
    const Halfedge before = previous_on_border(first);
    if (before == visible || !is_seen(p, before)) break;
    first = before;
  }
  border_.assign(1, first);
  for (;;) {
    const Halfedge next = next_on_border(border_.back());
    if (next == first || !is_seen(p, next)) break;
    border_.push_back(next);
  }
}

void ConstrainedHull::reach_out(Index p, Halfedge visible) {
  list_seen_border(p, visible);
  for (std::size_t i = border_.size(); i-- > 0;) {
    const Halfedge h = border_[i];
    const topology::HorizonEdge edge = {ends_of(h)[1], h};
    if (is_constrained(h) || !is_in_conflict(face_of(h), p)) {
      horizon_.push_back(edge);
      continue;
    }
    stack_.clear();
    enter(edge);
    spread(p);
  }
  // If p sees several edges of the border, all ghost faces at the vertices between them go, so that
  // one of them leads to the others.
  const Halfedge first = border_.front();
  const topology::HorizonEdge edge = {ends_of(first)[0], opposite(first)};
  if (is_in_conflict(face_of(edge.outside), p)) {
    stack_.clear();
    enter(edge);
    spread(p);
  } else {
    assert(border_.size() == 1);
    horizon_.push_back(edge);
  }
}

// Takes the face behind an edge, and leaves its other two edges to be crossed, the first one on
// top.
void ConstrainedHull::enter(const topology::HorizonEdge& edge) {
  const Index f = face_of(edge.outside);
  const topology::Face& face = mesh_[f];
  const unsigned next = next_corner[edge_of(edge.outside)];
  const unsigned previous = previous_corner[edge_of(edge.outside)];
  region_.push_back(f);
  stack_.push_back({face.vertex[edge_of(edge.outside)], face.opposite[previous]});
  stack_.push_back({face.vertex[previous], face.opposite[next]});
}

bool ConstrainedHull::is_crossed(Index p, Halfedge outside) const {
  const bool is_from_solid = is_solid(face_of(opposite(outside)));
  const bool is_to_solid = is_solid(face_of(outside));
  // The border is crossed where p lies on it, and from one side: ghost faces may be in conflict
  // then if the center is in their plane.
  if (is_from_solid != is_to_solid && (outside != forced_ || is_to_solid)) return false;
  if (is_to_solid && is_constrained(outside)) return outside == forced_;
  return is_in_conflict(face_of(outside), p);
}

// Crosses the edges of the stack, and lists those that cannot be crossed, counterclockwise.
void ConstrainedHull::spread(Index p) {
  while (!stack_.empty()) {
    const topology::HorizonEdge edge = stack_.back();
    stack_.pop_back();
    if (is_crossed(p, edge.outside)) {
      enter(edge);
      continue;
    }
    const bool is_inner_border = is_solid(face_of(edge.outside)) &&
                                 !is_solid(face_of(opposite(edge.outside))) &&
                                 is_seen(p, edge.outside);
    if (!is_inner_border) horizon_.push_back(edge);
  }
}

void ConstrainedHull::make_star(Index p) {
  for (const Index f : region_) kinds_.remove(f);
  topology::star(mesh_, p, horizon_, region_);
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const Halfedge outside = horizon_[i].outside;
    adopt(region_[i]);
    if (!is_constrained(outside)) continue;
    // An edge that leaves the border is constrained between its solid faces alone.
    const bool is_ghost = !is_solid(region_[i]) && !is_solid(face_of(outside));
    set_sides(outside, !is_ghost);
  }
}

// p is a new vertex on a constrained edge.
void ConstrainedHull::divide(Index p, const Edge& edge) {
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const Index v = horizon_[i].origin;
    if (v == edge[0] || v == edge[1]) set_sides(halfedge(region_[i], 2), true);
  }
  auto piece = sources_.extract(edge_between(edge[0], edge[1]));
  sources_[edge_between(edge[0], p)] = piece.mapped();
  sources_[edge_between(edge[1], p)] = std::move(piece.mapped());
}

void ConstrainedHull::restore_lifted(Index p) {
  for (LiftedEdge& edge : lifted_) {
    insertion_.insert(*this, p, edge.neighbor, [](Index /*v*/, Index /*w*/) {});
    sources_[edge_between(p, edge.neighbor)] = std::move(edge.constraints);
  }
  lifted_.clear();
}

}  // namespace rondel::constrained
