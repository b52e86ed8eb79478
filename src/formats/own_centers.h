// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds centers that belong to other cells, as in files whose centers and corners are in different
// orders.
//
// in    cells and their centers
// out   a remark, or an error
// index cells
#pragma once

#include <string>

#include "formats/netcdf_cells.h"
#include "rondel/cell_rings.h"

namespace rondel::formats {

// Let m be the mean direction of the corners of a cell, and r the distance to the farthest of them.
// The circle around m with the radius r contains the cell, if r is less than 60 degrees, and with
// it each point between corners: its centroid, its site, the middle of its bounds, one of its
// corners. A point that is as far from all corners is a center as well: the circumcenter of an
// obtuse triangle may lie far away.
//
// 1. Cells without corners, masked cells, and cells with r of 60 degrees or more pass.
// 2. Throws BadValue if a center is farther from m than 3 r and 3 times the median of r: pieces
//    that are cut from a cell may keep its center.
// 3. Throws BadValue if the centers of more than half of the cells are outside of their circles.
// 4. Returns a remark if some centers are outside, and otherwise an empty text.
//
// `cells` are those made of the mesh, whose centers are places, one for each cell, or none at all.
std::string require_own_centers(const MeshContent& mesh, const CellRings& cells);

}  // namespace rondel::formats
