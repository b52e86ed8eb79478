// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A cover of the sphere by triangles whose sides include those of given cells.
#pragma once

#include <vector>

#include "overlay/subdivision.h"
#include "rondel/types.h"

namespace rondel::overlay {

struct Filling {
  Subdivision cover;
  // Of each cell of the cover, the given cell that it is a part of; the number of these: none.
  std::vector<Index> owners;
};

// The Delaunay triangulation of the corners and of the ends of the axes, into which the sides of the cells are put, all
// of it exactly. Throws InvalidInput where cells overlap.
Filling filling_of(const Subdivision& cells, const Execution& execution);

}  // namespace rondel::overlay
