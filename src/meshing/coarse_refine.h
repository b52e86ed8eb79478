// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A refinement by angles that leaves small triangles as they are.
//
// in    a constrained triangulation, the region of each face, the length that is small at a place
// out   triangles
// index as in mesh::refine()
#pragma once

#include <functional>
#include <span>

#include "rondel/mesh_refine.h"

namespace rondel::meshing {

// Refines as mesh::refine() does, but no triangle of which all edges are shorter, as chords, than
// what `small` returns at a corner; an empty function: all are refined. So water that is much narrower than long costs no more triangles
// than it has lengths of that size.
mesh::RefinedMesh refine_coarsely(const ConstrainedTriangulation& given,
                                  std::span<const Index> regions,
                                  const mesh::RefineOptions& options,
                                  const std::function<double(const Point&)>& small,
                                  const Execution& execution);

}  // namespace rondel::meshing
