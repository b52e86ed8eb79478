// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Nodes at which a mesh touches itself.
//
//    \  M  /       M the mesh, G gaps. Of the triangles above and
//     \   /        below the node one set is filled.
//  G    o    G
//     /   \        .
//    /  M  \       .
// in    a mesh of a domain
// out   a mesh with one gap at most around each node
// index nodes and triangles of the mesh
#pragma once

#include <vector>

#include "rondel/mesh_triangles.h"

namespace rondel::meshing {

// Fills triangles where the mesh has several gaps around a node: of the triangles there that have
// edges in common those stay that have the largest area. Returns the filled area in steradians.
double fill_pinches(mesh::DomainTriangles& made);

// Takes triangles away, and nodes that are corners of none. What was beside them is coast.
void remove_triangles(const std::vector<bool>& is_removed, mesh::DomainTriangles& made);

}  // namespace rondel::meshing
