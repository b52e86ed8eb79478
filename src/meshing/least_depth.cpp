// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Depths that models need at every node.
#include <cmath>
#include <cstddef>

#include "rondel/error.h"
#include "rondel/triangle_mesh.h"

namespace rondel::mesh {

std::size_t deepen(TriangleMesh& mesh, double least_depth) {
  if (mesh.depths.empty()) throw InvalidInput("the mesh has no depths");
  if (!std::isfinite(least_depth)) throw InvalidInput("the least depth is not finite");
  std::size_t number = 0;
  for (double& depth : mesh.depths) {
    if (!(depth < least_depth)) continue;
    depth = least_depth;
    ++number;
  }
  return number;
}

}  // namespace rondel::mesh
