// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks of the arrays of a mesh.
//
// in    the arrays of a mesh
// out   InvalidInput where they are not those of a mesh
// index cells, edges and vertices, counted from 0
#pragma once

#include <algorithm>

#include "rondel/mesh.h"
#include "rondel/types.h"

namespace rondel::meshing {

// True if |p| is the radius up to a relative 0.001, which allows for single precision.
bool is_on_sphere(const Point& p, double radius);

// True if an edge has only one cell, or a vertex fewer than three: if one of these cells is
// no_index.
template <class Cells>
bool is_at_border(const Cells& cells) {
  return std::ranges::find(cells, no_index) != cells.end();
}
// True if an edge of the mesh has only one cell.
inline bool has_border(const mesh::VoronoiMesh& arrays) {
  return std::ranges::any_of(arrays.cells_on_edge,
                             [](const auto& cells) { return cells[1] == no_index; });
}

// Throws InvalidInput where a number cannot be what it is said to be: an area that is not positive
// or more than that of the sphere, a length that is negative or more than a turn, an angle of more
// than a turn, a number that is not finite. An edge may have length 0; at the border a distance may
// be 0, and the area of a triangle is a sum of kites, which may be negative. The message has the
// name that MPAS gives to the array.
void require_possible_numbers(const mesh::VoronoiMesh& arrays, unsigned threads);

// Throws InvalidInput where a number is not that of the mesh's points, by far more than programs
// differ in: dcEdge, dvEdge, angleEdge between two cells and away from the poles, areaCell.
// Precondition: the lists fit together, with edges turned and rings counterclockwise.
void require_measures_of_points(const mesh::VoronoiMesh& arrays, unsigned threads);

// Throws InvalidInput where a size or an index does not fit, or a number is not possible.
void require_consistent(const mesh::VoronoiMesh& arrays, unsigned threads);

}  // namespace rondel::meshing
