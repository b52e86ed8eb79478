// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of faces (topology/canonical_order.h), some of which have changed.
//
// in    faces, of which those that did not change are in canonical order
// out   all faces in canonical order
// index vertices along the spatial order; faces before, and their places in the order
#pragma once

#include <cstdint>
#include <vector>

#include "constrained/constrained_faces.h"
#include "topology/triangulation_arrays.h"

namespace rondel::constrained {

// Writes faces, neighbors and constrained sides, and renumbers the ghost faces. The arrays are
// those that the faces were taken from.
void write_in_order(ConstrainedFaces& all, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides);

}  // namespace rondel::constrained
