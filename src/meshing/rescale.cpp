// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Changes the radius of a mesh: points and lengths by a factor, areas by its square. Angles and
// densities stay.
#include <array>
#include <vector>

#include "meshing/mesh_arrays.h"
#include "rondel/mesh.h"

namespace rondel::mesh {

void rescale(VoronoiMesh& arrays, double radius) {
  meshing::require_options({.radius = arrays.radius}, arrays.num_cells());
  meshing::require_options({.radius = radius}, arrays.num_cells());
  const double factor = radius / arrays.radius;
  if (factor == 1) return;
  for (std::vector<Point>* const points :
       {&arrays.cell_points, &arrays.edge_points, &arrays.vertex_points}) {
    for (Point& point : *points) {
      point = {point.x * factor, point.y * factor, point.z * factor};
    }
  }
  for (std::vector<double>* const lengths : {&arrays.cell_distances, &arrays.vertex_distances}) {
    for (double& length : *lengths) length *= factor;
  }
  const double square = factor * factor;
  for (std::vector<double>* const areas : {&arrays.cell_areas, &arrays.triangle_areas}) {
    for (double& area : *areas) area *= square;
  }
  for (std::array<double, 3>& kites : arrays.kite_areas) {
    for (double& area : kites) area *= square;
  }
  arrays.radius = radius;
}

}  // namespace rondel::mesh
