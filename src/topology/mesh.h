// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangulation data structure: a closed oriented surface of triangles, without coordinates.
//
//            v[2]                     edge i is opposite to corner i: it runs from
//            /  \                     v[i+1] to v[i+2], indices modulo 3;
//     edge 1/    \edge 0              halfedge 3*face + i is edge i seen from this face;
//          / face \                   opposite[i] is the same edge seen from the
//      v[0]--------v[1]               neighbor, so links need no search.
//            edge 2
//
// Invariant between operations: for every halfedge h, opposite(opposite(h)) == h, and its
// end points are those of its opposite in reverse order.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/large_arrays.h"

namespace rondel::topology {

using Halfedge = Index;

inline constexpr std::array<unsigned, 3> next_corner = {1, 2, 0};
inline constexpr std::array<unsigned, 3> previous_corner = {2, 0, 1};

// Which of three corners this one is, of which it is one. Without branches: nothing predicts it.
inline unsigned corner_of(const std::array<Index, 3>& corners, Index vertex) {
  return static_cast<unsigned>(corners[1] == vertex) +
         2 * static_cast<unsigned>(corners[2] == vertex);
}

inline Halfedge halfedge(Index face, unsigned edge) { return 3 * face + edge; }
inline Index face_of(Halfedge h) { return h / 3; }
inline unsigned edge_of(Halfedge h) { return h % 3; }

struct Face {
  std::array<Index, 3> vertex;
  std::array<Halfedge, 3> opposite;
};

class Mesh {
 public:
  void reserve(std::size_t faces) { system::reserve_large(faces_, faces); }

  // Slots, alive or not.
  [[nodiscard]] Index num_slots() const { return static_cast<Index>(faces_.size()); }
  [[nodiscard]] Index num_faces() const {
    return static_cast<Index>(faces_.size() - free_slots_.size());
  }
  [[nodiscard]] bool is_alive(Index f) const { return faces_[f].vertex[0] != no_index; }

  // visit(f) for the faces that are alive, in the order of their numbers.
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    for (Index f = 0; f < num_slots(); ++f) {
      if (is_alive(f)) visit(f);
    }
  }

  [[nodiscard]] const Face& operator[](Index f) const { return faces_[f]; }
  [[nodiscard]] Face& operator[](Index f) { return faces_[f]; }

  [[nodiscard]] Index neighbor(Index f, unsigned edge) const {
    return face_of(faces_[f].opposite[edge]);
  }

  Index add_face() {
    if (free_slots_.empty()) {
      faces_.push_back({});
      return num_slots() - 1;
    }
    const Index f = free_slots_.back();
    free_slots_.pop_back();
    return f;
  }

  void remove_face(Index f) {
    faces_[f].vertex[0] = no_index;
    free_slots_.push_back(f);
  }

  void link(Halfedge h, Halfedge g) {
    faces_[face_of(h)].opposite[edge_of(h)] = g;
    faces_[face_of(g)].opposite[edge_of(g)] = h;
  }

  // The halfedge that leaves the same corner in the next face counterclockwise around corner
  // i of f: crosses the edge from corner i+2 to corner i. Returned as 3*face + corner.
  [[nodiscard]] Index next_around(Index f, unsigned corner) const {
    const Halfedge h = faces_[f].opposite[next_corner[corner]];
    return halfedge(face_of(h), next_corner[edge_of(h)]);
  }

  // Clockwise: crosses the edge from corner i to corner i+1.
  [[nodiscard]] Index previous_around(Index f, unsigned corner) const {
    const Halfedge h = faces_[f].opposite[previous_corner[corner]];
    return halfedge(face_of(h), previous_corner[edge_of(h)]);
  }

 private:
  std::vector<Face> faces_;
  std::vector<Index> free_slots_;
};

// From the flat arrays of a result back to the data structure.
// The faces under the same numbers, their vertices renamed: names[v] for v.
Mesh link_faces(std::span<const Triple> faces, std::span<const Triple> neighbors,
                std::span<const Index> names);

}  // namespace rondel::topology
