// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Longitudes and latitudes for the nodes of a mesh, of which readers make triangles that are
// counterclockwise again. The nodes of a sliver may have rounded positions that turn it over: such a
// node gets another position, by a few units in the last place.
//
// in    a mesh whose triangles are counterclockwise
// out   a position for each node, with which they are too
// index nodes and triangles of the mesh
#pragma once

#include <vector>

#include "rondel/triangle_mesh.h"
#include "rondel/types.h"

namespace rondel::meshing {

// Returns the mesh's own positions if it has some, else those with few decimals where these are the
// node's, in the turn that begins at `west_deg` (rondel/longitudes.h), moved where they have to be.
// Throws InvalidInput (the position of the triangle) that says where if they cannot be.
std::vector<LonLat> sound_positions(const mesh::TriangleMesh& mesh, double west_deg = -180);

}  // namespace rondel::meshing
