// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes a mesh in canonical order (topology/canonical_order.h).
#pragma once

#include <vector>

#include "kernel/walk.h"
#include "topology/mesh.h"
#include "topology/triangulation_arrays.h"

namespace rondel::kernel {

// Writes faces and neighbors. Vertices of the mesh are ranks below names.size(); they are written
// under their names.
//
// Uses up the mesh: afterwards vertex[0] of each face is its place in the order. So the result
// needs no third array of the size of the mesh beside it. `scratch` lends its memory.
void write_canonical(topology::Mesh& mesh, const std::vector<Index>& names,
                     std::vector<Index> scratch, TriangulationArrays& arrays);

// Lists the faces that are not solid, in their order, once write_canonical has used up the mesh.
void report_ghosts(const topology::Mesh& mesh, const FaceKinds& kinds, std::vector<Index>& ghosts);

}  // namespace rondel::kernel
