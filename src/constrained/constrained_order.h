// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of faces (topology/canonical_order.h), some of which have changed.
//
// in    faces, of which those that did not change are in canonical order
// out   all faces in canonical order
// index vertices along the spatial order; faces before, and their places in the order
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

// Faces that start with their owners, their corners being vertices.
struct FacesToOrder {
  std::span<const Triple> faces;
  std::span<const Triple> neighbors;
  std::span<const std::uint8_t> sides;
  std::span<const std::uint8_t> states;
  // By vertex: whether a face that changed has, or had, this owner.
  std::span<const std::uint8_t> is_touched;
  std::span<const Index> names;  // by vertex

  [[nodiscard]] bool is_solid(std::size_t f) const { return (states[f] & ghost_face) == 0; }
};

// Writes faces, neighbors and constrained sides, and renumbers the ghost faces, which the arrays
// have by the numbers of the faces before.
void write_in_order(const FacesToOrder& all, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides);

}  // namespace rondel::constrained
