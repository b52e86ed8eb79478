// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of the result: it depends on the surface alone, not on how it was built.
#pragma once

#include <vector>

#include "rondel/triangulation.h"
#include "topology/mesh.h"

namespace rondel::incremental {

// The faces of a mesh in the canonical order, each as 3*face + first corner: a face
// belongs to its corner of smallest rank and starts with it. The faces of one owner
// follow counterclockwise, beginning with the one whose second corner has the smallest rank.
// `num_ranks` bounds the vertices of the mesh; `scratch` lends its memory.
std::vector<topology::Halfedge> canonical_order(const topology::Mesh& mesh, Index num_ranks,
                                                std::vector<Index> scratch);

// Writes faces and neighbors in this order, vertices under the names of their ranks. Uses up the
// mesh: afterwards vertex[0] of each face is its place in the order. So the result needs
// no third array of the size of the mesh beside it.
void write_canonical(topology::Mesh& mesh, const std::vector<topology::Halfedge>& order,
                     const std::vector<Index>& names, TriangulationArrays& arrays);

}  // namespace rondel::incremental
