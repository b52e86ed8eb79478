// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "topology/mesh.h"

namespace rondel::topology {

Mesh link_faces(std::span<const Triple> faces, std::span<const Triple> neighbors,
                std::span<const Index> names) {
  Mesh mesh;
  mesh.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Face& face = mesh[mesh.add_face()];
    for (unsigned i = 0; i < 3; ++i) {
      face.vertex[i] = names[faces[f][i]];
      const Index g = neighbors[f][i];
      // There the edge begins where it ends here.
      const unsigned corner = corner_of(faces[g], faces[f][previous_corner[i]]);
      face.opposite[i] = halfedge(g, previous_corner[corner]);
    }
  }
  return mesh;
}

}  // namespace rondel::topology
