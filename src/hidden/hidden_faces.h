// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces below which the hidden sites lie.
#pragma once

#include <span>

#include "rondel/types.h"
#include "topology/triangulation_arrays.h"

namespace rondel::hidden {

// Sets `face` of every hidden site: the first solid face, in the order of the faces, whose closed
// cone from the center contains the site; for a site at the center the first solid face. So it is
// a function of the set of sites, also for a site whose ray meets an edge or a vertex.
//
// The hidden sites of a regular triangulation in dimension 2 lie in its hull, so their rays do
// meet solid faces. Expected time is constant for each site. All else in `arrays` must be final.
// The result does not depend on `threads`, of which 0 means one for each core.
void assign_hidden_faces(std::span<const Point> sites, const Point& center,
                         TriangulationArrays& arrays, unsigned threads);

}  // namespace rondel::hidden
