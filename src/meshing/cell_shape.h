// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The quantities of one cell that reports on quality need, on the unit sphere.
//
// in    the arrays of a mesh, a cell or an edge
// out   numbers without unit, but for the spacing (radians) and the energy
// index cells and edges of the mesh
#pragma once

#include <cstddef>

#include "rondel/mesh.h"

namespace rondel::meshing {

// The shape of a cell; mesh::CellQuality (rondel/mesh_quality.h) documents the ratios.
struct CellShape {
  double spacing = 0;
  double centroid_offset =
      0;              // distance of site and center of mass over the spacing; mass has the density
                      // of the cells
  double energy = 0;  // integral of the squared distance from the site over the cell
  double min_edge_ratio = 0;
  double side_ratio = 0;
  double distance_ratio = 0;
  double gradient = 0;
};

// Returns the shape of a cell. It takes the areas and lengths of the arrays, and its moment from
// the corners.
CellShape shape_of(const mesh::VoronoiMesh& arrays, std::size_t cell);

// Returns the difference of the spacings of the two cells of an edge over their mean; 0 at the
// border.
double gradient_of(const mesh::VoronoiMesh& arrays, std::size_t edge);

}  // namespace rondel::meshing
