// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The incremental algorithm (the paper, section 4), one for both models: locate a face in
// conflict with the new site, find the conflict region by depth-first search,
// replace it by the star of the site. Sites that are in conflict with no face are hidden.
//
// The first hull is flat: three sites that span a plane not through the center, as two faces
// back to back. Any further site is in conflict with exactly one of them,
// ties being broken, and the hull becomes a body. Nothing has to surround the
// center, and no dummy points are needed.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "incremental/location.h"
#include "incremental/sphere_traits.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::incremental {

template <SphereTraits T>
class Insertion {
 public:
  // `first` are three sites with a non-zero orientation.
  Insertion(const T& sites, std::array<Index, 3> first) : sites_(sites) {
    if constexpr (!T::hides_sites) mesh_.reserve(2 * static_cast<std::size_t>(sites.size()));
    if (sites.orientation(first[0], first[1], first[2]) == Sign::negative) {
      std::swap(first[1], first[2]);
    }
    const auto& [a, b, c] = first;
    const Index top = mesh_.add_face();
    const Index bottom = mesh_.add_face();
    mesh_[top].vertex = {a, b, c};
    mesh_[bottom].vertex = {a, c, b};
    mesh_.link(topology::halfedge(top, 0), topology::halfedge(bottom, 0));
    mesh_.link(topology::halfedge(top, 1), topology::halfedge(bottom, 2));
    mesh_.link(topology::halfedge(top, 2), topology::halfedge(bottom, 1));
    kinds_.add(top, FaceKind::solid);
    kinds_.add(bottom, FaceKind::near);
    solid_ = top;
    near_ = bottom;
  }

  void insert(Index p) {
    const Index start = Location<T>(sites_, mesh_, kinds_).find_conflict(p, solid_, near_);
    if (start == no_index) return;
    find_conflict_region(p, start);
    assert(horizon_.size() >= 3);
    if (!tracks_kinds_) {
      topology::star(mesh_, p, horizon_, region_);
      solid_ = region_.front();
      return;
    }
    for (const Index f : region_) kinds_.remove(f);
    topology::star(mesh_, p, horizon_, region_);
    classify_star();
  }

  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] topology::Mesh& mesh() { return mesh_; }
  [[nodiscard]] const FaceKinds& kinds() const { return kinds_; }

  // A solid face above p, a hidden site; successive calls for close sites are fast.
  [[nodiscard]] Index face_above(Index p) {
    solid_ = Location<T>(sites_, mesh_, kinds_).face_above(p, solid_);
    return solid_;
  }

 private:
  // Depth first, so that the horizon comes in counterclockwise order: entering a face through its
  // edge j, the edges j+1 and j+2 take the place of the edge just crossed.
  //
  // Where no vertex can become hidden, the region has no inner vertex and its dual
  // graph is a tree: no face is met twice. Otherwise visited faces are marked.
  void find_conflict_region(Index p, Index start) {
    region_.assign(1, start);
    horizon_.clear();
    stack_.clear();
    mark(start, true);
    for (const unsigned edge : {2U, 1U, 0U}) stack_.push_back(topology::halfedge(start, edge));
    while (!stack_.empty()) {
      const topology::Halfedge h = stack_.back();
      stack_.pop_back();
      const topology::Face& face = mesh_[topology::face_of(h)];
      const unsigned edge = topology::edge_of(h);
      const topology::Halfedge opposite = face.opposite[edge];
      const Index neighbor = topology::face_of(opposite);
      if (is_marked(neighbor)) continue;
      const auto& v = mesh_[neighbor].vertex;
      if (!sites_.is_in_conflict(v[0], v[1], v[2], p)) {
        horizon_.push_back({face.vertex[topology::next_corner[edge]], opposite});
        continue;
      }
      mark(neighbor, true);
      region_.push_back(neighbor);
      const unsigned entered = topology::edge_of(opposite);
      stack_.push_back(topology::halfedge(neighbor, topology::previous_corner[entered]));
      stack_.push_back(topology::halfedge(neighbor, topology::next_corner[entered]));
    }
    for (const Index f : region_) mark(f, false);
  }

  void mark(Index f, bool value) {
    if constexpr (T::hides_sites) {
      if (f >= marks_.size()) marks_.resize(std::max<std::size_t>(f + 1, 2 * marks_.size()));
      marks_[f] = value;
    }
  }

  [[nodiscard]] bool is_marked(Index f) const {
    if constexpr (T::hides_sites) return f < marks_.size() && marks_[f];
    return false;
  }

  // Where the walks start next. A solid (near) face can only vanish if the star has one too:
  // what it covers, seen from the center, is covered by the star afterwards.
  void classify_star() {
    near_ = near_ != no_index && is_current(near_, FaceKind::near) ? near_ : no_index;
    for (const Index f : region_) {
      const auto& v = mesh_[f].vertex;
      const FaceKind kind = kind_of(sites_.orientation(v[0], v[1], v[2]));
      kinds_.add(f, kind);
      if (kind == FaceKind::solid) solid_ = f;
      if (kind == FaceKind::near) near_ = f;
    }
    if (kinds_.all_solid()) {
      tracks_kinds_ = false;
      kinds_.release();
    }
  }

  // Whether f still has the kind it is remembered for: it may be a removed or reused slot.
  [[nodiscard]] bool is_current(Index f, FaceKind kind) const {
    return mesh_.is_alive(f) && std::find(region_.begin(), region_.end(), f) == region_.end() &&
           kinds_[f] == kind;
  }

  const T& sites_;
  topology::Mesh mesh_;
  FaceKinds kinds_;
  bool tracks_kinds_ = true;
  Index solid_ = no_index;
  Index near_ = no_index;
  std::vector<Index> region_;
  std::vector<topology::HorizonEdge> horizon_;
  std::vector<topology::Halfedge> stack_;
  std::vector<bool> marks_;
};

}  // namespace rondel::incremental
