// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the reports on quality ask of a cell, on the unit sphere.
#pragma once

#include <cstddef>

#include "rondel/mesh.h"

namespace rondel::meshing {

struct CellShape {
  double spacing = 0;
  double centroid_offset =
      0;              // in spacings; the center of mass is that of the density of the cells
  double energy = 0;  // the integral of the squared distance from the site
  double least_edge_ratio = 0;
  double side_ratio = 0;
  double distance_ratio = 0;
  double gradient = 0;
};

CellShape shape_of(const mesh::MeshArrays& arrays, std::size_t cell);

// The difference of the spacings of the cells of an edge over their mean; 0 at the border.
double gradient_of(const mesh::MeshArrays& arrays, std::size_t edge);

}  // namespace rondel::meshing
