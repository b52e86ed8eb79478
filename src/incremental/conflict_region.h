// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces in conflict with a point, and their horizon.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "incremental/sphere_traits.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::incremental {

template <SphereTraits T>
class ConflictRegion {
 public:
  // Depth first from `start`, a face in conflict, so that the horizon comes in counterclockwise
  // order: entering a face through its edge j, the edges j+1 and j+2 take the place of the edge
  // just crossed.
  //
  // Where no vertex can become hidden, the region has no inner vertex and its dual
  // graph is a tree: no face is met twice. Otherwise visited faces are remembered.
  void find(const T& sites, const topology::Mesh& mesh, Index p, Index start) {
    faces_.assign(1, start);
    horizon_.clear();
    stack_.clear();
    for (const unsigned edge : {2U, 1U, 0U}) stack_.push_back(topology::halfedge(start, edge));
    while (!stack_.empty()) {
      const topology::Halfedge h = stack_.back();
      stack_.pop_back();
      const topology::Face& face = mesh[topology::face_of(h)];
      const unsigned edge = topology::edge_of(h);
      const topology::Halfedge opposite = face.opposite[edge];
      const Index neighbor = topology::face_of(opposite);
      if (is_known(neighbor)) continue;
      const auto& v = mesh[neighbor].vertex;
      if (!sites.is_in_conflict(v[0], v[1], v[2], p)) {
        horizon_.push_back({face.vertex[topology::next_corner[edge]], opposite});
        continue;
      }
      add(neighbor);
      const unsigned entered = topology::edge_of(opposite);
      stack_.push_back(topology::halfedge(neighbor, topology::previous_corner[entered]));
      stack_.push_back(topology::halfedge(neighbor, topology::next_corner[entered]));
    }
    if (T::hides_sites && faces_.size() >= few) {
      for (const Index f : faces_) marks_[f] = false;
    }
  }

  [[nodiscard]] const std::vector<topology::HorizonEdge>& horizon() const { return horizon_; }
  [[nodiscard]] const std::vector<Index>& faces() const { return faces_; }
  // For topology::star, which leaves the faces of the star there.
  [[nodiscard]] std::vector<Index>& faces() { return faces_; }

 private:
  // A region this small is searched faster than marks, which lie anywhere in memory.
  static constexpr std::size_t few = 16;

  void add(Index f) {
    faces_.push_back(f);
    if constexpr (T::hides_sites) {
      if (faces_.size() < few) return;
      if (faces_.size() > few) {
        mark(f);
      } else {
        for (const Index known : faces_) mark(known);
      }
    }
  }

  void mark(Index f) {
    if (f >= marks_.size()) marks_.resize(std::max<std::size_t>(f + 1, 2 * marks_.size()));
    marks_[f] = true;
  }

  [[nodiscard]] bool is_known(Index f) const {
    if constexpr (!T::hides_sites) return false;
    if (faces_.size() >= few) return f < marks_.size() && marks_[f];
    return std::find(faces_.begin(), faces_.end(), f) != faces_.end();
  }

  std::vector<Index> faces_;
  std::vector<topology::HorizonEdge> horizon_;
  std::vector<topology::Halfedge> stack_;
  std::vector<bool> marks_;
};

}  // namespace rondel::incremental
