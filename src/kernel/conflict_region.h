// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces in conflict with a point, and their horizon.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/conflict_test.h"
#include "system/prefetch.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::kernel {

template <models::SphereTraits T>
class ConflictRegion {
 public:
  // Depth first from `start`, a face in conflict, so that the horizon comes in counterclockwise
  // order: entering a face through its edge j, the edges j+1 and j+2 take the place of the edge
  // just crossed. The faces behind these two are tested together, since neither test waits for the
  // other.
  //
  // Where no vertex can become hidden, the region has no inner vertex and its dual
  // graph is a tree: no face is met twice. Otherwise visited faces are remembered.
  void find(ConflictTest<T>& test, const topology::Mesh& mesh, Index p, Index start) {
    faces_.assign(1, start);
    horizon_.clear();
    stack_.clear();
    const topology::Face& face = mesh[start];
    const auto& last = mesh[topology::face_of(face.opposite[2])].vertex;
    stack_.push_back({face.vertex[0], face.opposite[2], test.is_in_conflict(last, p)});
    Crossing next = cross_edges(test, mesh, p, face, 0, 1);
    for (;;) {
      if (next.is_in_conflict) {
        const Index f = topology::face_of(next.outside);
        if (!is_known(f)) {
          add(f);
          const unsigned entered = topology::edge_of(next.outside);
          next = cross_edges(test, mesh, p, mesh[f], topology::next_corner[entered],
                             topology::previous_corner[entered]);
          continue;
        }
      } else {
        horizon_.push_back({next.origin, next.outside});
      }
      if (stack_.empty()) break;
      next = stack_.back();
      stack_.pop_back();
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
  struct Crossing {
    Index origin;
    topology::Halfedge outside;
    bool is_in_conflict;  // the face there
  };

  // Returns the first crossing and leaves the second for later. Edge i runs from corner i+1.
  [[gnu::always_inline]] Crossing cross_edges(ConflictTest<T>& test, const topology::Mesh& mesh,
                                              Index p, const topology::Face& face, unsigned first,
                                              unsigned second) {
    const topology::Halfedge a = face.opposite[first];
    const topology::Halfedge b = face.opposite[second];
    prefetch_beyond(mesh, a);
    prefetch_beyond(mesh, b);
    const auto [is_a, is_b] = test.are_in_conflict(mesh[topology::face_of(a)].vertex,
                                                   mesh[topology::face_of(b)].vertex, p);
    stack_.push_back({face.vertex[topology::next_corner[second]], b, is_b});
    return {face.vertex[topology::next_corner[first]], a, is_a};
  }

  // The faces that are tested next if the one behind h is in conflict: they arrive while the
  // coordinates of its corner do.
  static void prefetch_beyond(const topology::Mesh& mesh, topology::Halfedge h) {
    const topology::Face& face = mesh[topology::face_of(h)];
    const unsigned entered = topology::edge_of(h);
    system::prefetch(&mesh[topology::face_of(face.opposite[topology::next_corner[entered]])]);
    system::prefetch(&mesh[topology::face_of(face.opposite[topology::previous_corner[entered]])]);
  }

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
  std::vector<Crossing> stack_;
  std::vector<bool> marks_;
};

}  // namespace rondel::kernel
