// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of faces (topology/canonical_order.h), some of which have changed.
//
// in    faces that start with their owners
// out   all faces in canonical order
// index names and ranks of vertices, along the spatial order; faces before, and their places in the
//       order
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "topology/triangulation_arrays.h"

namespace rondel::constrained {

// The marks that a face may have.
enum FaceState : std::uint8_t {
  ghost_face = 1,
  changed_face = 2,    // it was not there, in this place, in the canonical order before
  face_in_cavity = 4,  // it is about to be replaced
};

// Faces whose corners are ranks.
struct FacesToOrder {
  std::span<const Triple> faces;
  std::span<const Triple> neighbors;
  std::span<const std::uint8_t> sides;
  std::span<const std::uint8_t> states;
  // Not 0 for the rank of an owner that has, or had, a face that changed. The other owners have their
  // faces in order.
  std::span<const std::uint8_t> is_touched;
  std::span<const Index> names;  // by rank
};

// Writes faces, neighbors and constrained sides, and renumbers the ghost faces, which the arrays
// have by the numbers of the faces before.
void write_in_order(const FacesToOrder& all, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides);

// Faces whose corners are names. Those that did not change are in order.
struct FacesInPlace {
  std::span<Triple> faces;
  std::span<Triple> neighbors;
  std::span<std::uint8_t> sides;
  std::span<const std::uint8_t> states;
  std::span<const Index> ranks;  // by name
};

// A face that changed, and the rank of its owner before.
struct ChangedFace {
  Index face;
  Index owner;
};

// Moves faces to their places, which takes less than to write them if few have changed, and renumbers
// the ghost faces. Sorts the faces that changed.
void put_in_order(const FacesInPlace& all, unsigned threads, std::vector<ChangedFace>& changed,
                  std::vector<Index>& ghost_faces);

}  // namespace rondel::constrained
