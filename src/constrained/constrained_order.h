// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of faces (topology/canonical_order.h), some of which have changed, and that of
// vertices, on which it rests.
//
// in    a triangulation; its faces, of which those that did not change are in canonical order
// out   the order of its vertices; all faces in canonical order
// index names; vertices along the spatial order; faces before, and their places in the order
#pragma once

#include <cstdint>
#include <vector>

#include "constrained/constrained_faces.h"
#include "constrained/constraints.h"
#include "topology/triangulation_arrays.h"

namespace rondel::constrained {

// Returns the names of the vertices along the spatial order.
std::vector<Index> names_in_order(const Triangulation& triangulation, const NamedSites& sites,
                                  unsigned threads);

// Writes faces, neighbors, ghost faces and constrained sides. `before` is what the faces were made of.
void write_in_order(const ConstrainedFaces& all, const Triangulation& before, unsigned threads,
                    TriangulationArrays& arrays, std::vector<std::uint8_t>& sides);

}  // namespace rondel::constrained
