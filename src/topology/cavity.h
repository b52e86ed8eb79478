// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Replaces a conflict region by the star of a vertex.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "rondel/export.h"
#include "topology/mesh.h"

namespace rondel::topology {

// Adds two faces back to back, (a, b, c) and (a, c, b): the smallest surface. Returns both.
RONDEL_API std::pair<Index, Index> flat_pair(Mesh& mesh, const std::array<Index, 3>& corners);

// An edge of the horizon: from `origin` to the origin of the next one, seen from outside.
struct HorizonEdge {
  Index origin;
  Halfedge outside;
};

// Fills the hole with the star of vertex v: one face (v, a, b) for each horizon edge a -> b,
// counterclockwise, in the slots of the removed faces first. On return `slots` has the
// faces of the star in the order of the horizon.
//
//        b ------- a'            face i:      corner 0 = v, corner 1 = a_i, corner 2 = b_i
//       / \  i+1  /              its edge 0:  the horizon edge
//      / i \     /               its edge 1:  shared with face i+1, b_i = a_{i+1}
//     a --- v --                 its edge 2:  shared with face i-1
//
RONDEL_API void star(Mesh& mesh, Index v, std::span<const HorizonEdge> horizon,
                     std::vector<Index>& slots);

}  // namespace rondel::topology
