// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Removal of a vertex v: its star becomes holes, which the triangulations of their corners fill
// (dynamic/link_triangulation.h; docs/theory/constrained.md, "Removal of a site").
//
// 1. If v is not on the border, the hole is its link; a constraint that passes v divides it in two.
// 2. If v is on the border, the border that is to come divides its link: within it are holes of
//    solid faces, and between it and the ghost faces is one hole of ghost faces.
//
//     u --- n --- n          The new border goes from u, the vertex before v on the border, to w,
//      \    /\    /\         the one behind it, convex, along neighbors n of v. Here it is u, c,
//       c--'  `--'  c--- w   c, w; a hole is at each edge that is none of the link.
//        `--.  |  .-'
//            ` v '

#include <algorithm>
#include <cassert>
#include <utility>

#include "constrained/constrained_hull.h"

namespace rondel::constrained {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::next_corner;
using topology::previous_corner;

// Returns the corner of a solid face at v with which a turn around v begins, as 3 * face + corner:
// on the border the one behind the ghost faces.
Halfedge ConstrainedHull::first_corner_at(Index v) const {
  Halfedge h = corner_of_[v];
  do {
    const Halfedge before = mesh_.previous_around(face_of(h), edge_of(h));
    if (!is_solid(face_of(before))) return h;
    h = before;
  } while (h != corner_of_[v]);
  return h;
}

// Lists the faces around v, counterclockwise: from the border on, if v is there.
void ConstrainedHull::list_spokes(Index v) {
  spokes_.clear();
  num_solid_ = 0;
  Halfedge h = corner_of_[v];
  Halfedge back = h;
  do {
    const Index f = face_of(h);
    const unsigned corner = edge_of(h);
    spokes_.push_back({f, mesh_[f].vertex[next_corner[corner]], mesh_[f].opposite[corner],
                       halfedge(f, previous_corner[corner])});
    num_solid_ += is_solid(f) ? 1 : 0;
    prefetch(spokes_.back().neighbor);
    system::prefetch_to_write(&mesh_[face_of(spokes_.back().outer)]);
    h = mesh_.next_around(f, corner);
    // The other way around, so that the second half is there when it is needed.
    back = mesh_.previous_around(face_of(back), edge_of(back));
    system::prefetch(&mesh_[face_of(back)]);
  } while (h != corner_of_[v]);
  if (num_solid_ == spokes_.size()) return;
  const auto is_of_solid = [this](const StarSpoke& spoke) { return is_solid(spoke.face); };
  const auto ghost = std::find_if_not(spokes_.begin(), spokes_.end(), is_of_solid);
  std::rotate(spokes_.begin(), std::find_if(ghost, spokes_.end(), is_of_solid), spokes_.end());
}

bool ConstrainedHull::is_on_border(Index v) const {
  const Halfedge first = first_corner_at(v);
  return !is_solid(face_of(mesh_.previous_around(face_of(first), edge_of(first))));
}

std::vector<Index> ConstrainedHull::neighbors(Index v) const {
  std::vector<Index> neighbors;
  const Halfedge first = first_corner_at(v);
  Halfedge h = first;
  do {
    neighbors.push_back(mesh_[face_of(h)].vertex[next_corner[edge_of(h)]]);
    if (!is_solid(face_of(h))) break;
    h = mesh_.next_around(face_of(h), edge_of(h));
  } while (h != first);
  return neighbors;
}

std::span<const Index> ConstrainedHull::collect_star(Index v) {
  list_spokes(v);
  link_.clear();
  for (std::size_t i = 0; i < num_solid_; ++i) link_.push_back(spokes_[i].neighbor);
  if (num_solid_ < spokes_.size()) link_.push_back(spokes_[num_solid_].neighbor);
  return link_;
}

// Returns the neighbors to which constrained edges lead.
std::vector<Index> ConstrainedHull::constrained_neighbors() const {
  std::vector<Index> neighbors;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const bool is_of_solid = i < num_solid_ || i == num_solid_;
    if (is_of_solid && is_constrained(spokes_[i].edge)) neighbors.push_back(spokes_[i].neighbor);
  }
  return neighbors;
}

std::optional<ConstrainedHull::Edge> ConstrainedHull::crossing_at(Index v) {
  list_spokes(v);
  const std::vector<Index> neighbors = constrained_neighbors();
  if (neighbors.empty()) return {};
  const Index first = sources_.at(edge_between(v, neighbors.front())).front();
  for (const Index neighbor : neighbors) {
    const std::vector<Index>& constraints = sources_.at(edge_between(v, neighbor));
    if (std::ranges::find(constraints, first) == constraints.end()) {
      return Edge{std::min(first, constraints.front()), std::max(first, constraints.front())};
    }
  }
  return {};
}

// True if what is constrained at v passes it.
bool ConstrainedHull::is_passed(Index v, const std::vector<Index>& neighbors) const {
  if (neighbors.size() != 2) return false;
  if (side(neighbors[0], neighbors[1], v) != Sign::zero) return false;
  std::vector<Index> one = sources_.at(edge_between(v, neighbors[0]));
  std::vector<Index> other = sources_.at(edge_between(v, neighbors[1]));
  std::ranges::sort(one);
  std::ranges::sort(other);
  return one == other;
}

// Takes the constraints from edges at v, which become Delaunay.
void ConstrainedHull::lift(Index v, const std::vector<Index>& neighbors) {
  for (const Index neighbor : neighbors) {
    Index a = v;
    Index b = neighbor;
    const Departure step = ArcInsertion<ConstrainedHull>::departure(*this, a, b);
    auto piece = sources_.extract(edge_between(v, neighbor));
    lifted_.push_back({neighbor, std::move(piece.mapped())});
    release(step.halfedge);
  }
}

void ConstrainedHull::remove_vertex(Index v) {
  std::vector<Index> passing = constrained_neighbors();
  std::vector<Index> constraints;
  if (is_passed(v, passing)) {
    constraints = std::move(sources_.extract(edge_between(v, passing[0])).mapped());
    sources_.erase(edge_between(v, passing[1]));
  } else if (!passing.empty()) {
    lift(v, passing);
    passing.clear();
    collect_star(v);
  }
  empty_star(v);
  if (num_solid_ == spokes_.size()) {
    fill_around(passing);
  } else {
    fill_behind_border();
  }
  for (const Index f : free_faces_) mesh_.remove_face(f);
  solid_face_ = solid_face_at(link_.front());
  if (passing.empty()) return;
  Index a = passing[0];
  Index b = passing[1];
  constrain(ArcInsertion<ConstrainedHull>::departure(*this, a, b).halfedge);
  sources_[edge_between(passing[0], passing[1])] = std::move(constraints);
}

void ConstrainedHull::empty_star(Index v) {
  free_faces_.clear();
  for (const StarSpoke& spoke : spokes_) {
    kinds_.remove(spoke.face);
    free_faces_.push_back(spoke.face);
  }
  corner_of_[v] = no_index;
  // Neighbors of which no other solid face is new have one beyond their edges.
  for (std::size_t i = 0; i < num_solid_; ++i) {
    const Index beyond = face_of(spokes_[i].outer);
    if (is_solid(beyond)) set_corners(beyond);
  }
}

// Fills the link of a vertex that is not on the border. An arc between two of its vertices, if any,
// divides it.
void ConstrainedHull::fill_around(const std::vector<Index>& passing) {
  if (passing.empty()) {
    hole_.clear();
    for (const StarSpoke& spoke : spokes_) hole_.push_back({spoke.neighbor, spoke.outer});
    fill(true);
    return;
  }
  const auto begin = std::ranges::find(spokes_, passing[0], &StarSpoke::neighbor);
  std::rotate(spokes_.begin(), begin, spokes_.end());
  const auto end = std::ranges::find(spokes_, passing[1], &StarSpoke::neighbor);
  hole_.clear();
  for (auto spoke = spokes_.begin(); spoke != end; ++spoke) {
    hole_.push_back({spoke->neighbor, spoke->outer});
  }
  hole_.push_back({passing[1], no_index});
  const Halfedge one = fill(false);
  hole_.clear();
  for (auto spoke = end; spoke != spokes_.end(); ++spoke) {
    hole_.push_back({spoke->neighbor, spoke->outer});
  }
  hole_.push_back({passing[0], no_index});
  mesh_.link(one, fill(false));
}

// Lists the spokes of solid faces that lead to the new border, clockwise around v: from u to w.
// The spoke num_solid_ leads to u.
void ConstrainedHull::list_new_border() {
  chain_.clear();
  const auto vertex = [this](std::size_t k) { return spokes_[k].neighbor; };
  for (std::size_t i = num_solid_ + 1; i-- > 0;) {
    while (chain_.size() >= 2 && side(vertex(chain_[chain_.size() - 2]), vertex(chain_.back()),
                                      vertex(i)) == Sign::negative) {
      chain_.pop_back();
    }
    chain_.push_back(i);
  }
}

void ConstrainedHull::fill_behind_border() {
  list_new_border();
  std::vector<HoleEdge> below;  // the hole of ghost faces, from u on
  for (std::size_t i = num_solid_; i < spokes_.size(); ++i) {
    below.push_back({spokes_[i].neighbor, spokes_[i].outer});
  }
  for (std::size_t k = chain_.size() - 1; k > 0; --k) {
    const std::size_t first = chain_[k];
    const std::size_t last = chain_[k - 1];
    hole_.clear();
    for (std::size_t i = first; i < last; ++i) {
      hole_.push_back({spokes_[i].neighbor, spokes_[i].outer});
    }
    hole_.push_back({spokes_[last].neighbor, no_index});
    below.push_back({spokes_[first].neighbor, fill(false)});
  }
  hole_ = std::move(below);
  if (hole_.size() == 2) {
    close_up();
  } else {
    fill(true);
  }
}

// Closes a hole of two edges.
void ConstrainedHull::close_up() {
  const auto [one, other] = std::array{hole_[0].outer, hole_[1].outer};
  mesh_.link(one, other);
  set_sides(one, is_constrained(one) || is_constrained(other));
}

// Triangulates a hole, whose last edge has nothing beyond it unless it is closed; then that edge is
// returned, seen from the inside.
Halfedge ConstrainedHull::fill(bool is_closed) {
  if (hole_.size() == 2) return hole_[0].outer;
  corners_.clear();
  for (const HoleEdge& edge : hole_) corners_.push_back(edge.vertex);
  triangulation_.run(sites_, corners_);
  const auto faces = triangulation_.faces();
  slots_.clear();
  while (slots_.size() < faces.size()) {
    if (free_faces_.empty()) {
      slots_.push_back(mesh_.add_face());
    } else {
      slots_.push_back(free_faces_.back());
      free_faces_.pop_back();
    }
  }
  Halfedge base = no_index;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    for (unsigned i = 0; i < 3; ++i) mesh_[slots_[k]].vertex[i] = corners_[faces[k].vertex[i]];
    adopt(slots_[k]);
    for (unsigned i = 0; i < 3; ++i) {
      const Halfedge inside = halfedge(slots_[k], i);
      const Halfedge other = faces[k].opposite[i];
      if (other != no_index) {
        mesh_[slots_[k]].opposite[i] = halfedge(slots_[face_of(other)], edge_of(other));
        continue;
      }
      const std::size_t edge = faces[k].vertex[next_corner[i]];
      if (!is_closed && edge + 1 == hole_.size()) {
        base = inside;
        continue;
      }
      mesh_.link(inside, hole_[edge].outer);
      if (is_constrained(hole_[edge].outer)) set_side(inside, true);
    }
  }
  return base;
}

}  // namespace rondel::constrained
