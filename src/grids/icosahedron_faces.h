// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of the icosahedron, in the order in which grids of triangles have them.
//
// in    the corners, mesh::icosahedron()
// out   three corners for each face, counterclockwise
// index corners as given; faces by their corners in ascending order
#pragma once

#include <array>
#include <vector>

#include "rondel/types.h"

namespace rondel::grids {

using IcosahedronFace = std::array<Index, 3>;

// Returns the 20 faces. The first corner of each has the lowest index.
std::vector<IcosahedronFace> icosahedron_faces(const std::vector<Point>& corners);

}  // namespace rondel::grids
