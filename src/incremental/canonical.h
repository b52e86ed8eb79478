// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of the result: it depends on the surface alone, not on how it was built.
#pragma once

#include <vector>

#include "rondel/triangulation.h"
#include "topology/mesh.h"

namespace rondel::incremental {

// The place of each face of a mesh in the canonical order: a face belongs to its corner of smallest
// rank and starts with it. The faces of one owner follow counterclockwise,
// beginning with the one whose second corner has the smallest rank.
struct CanonicalOrder {
  std::vector<Index> place;    // of each slot; no_index if it is not alive
  std::vector<Index> corners;  // m: the slot and its first corner, 3*face + corner
};

// `num_ranks` bounds the vertices of the mesh.
CanonicalOrder canonical_order(const topology::Mesh& mesh, Index num_ranks);

// Writes faces and neighbors in this order, vertices under the names of their ranks.
void write_canonical(const topology::Mesh& mesh, const CanonicalOrder& order,
                     const std::vector<Index>& names, TriangulationArrays& arrays);

}  // namespace rondel::incremental
