// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "topology/mesh.h"

namespace rondel::topology {
namespace {

// The edge of a face that runs from a to b. Two faces can share two edges.
unsigned edge_between(const Triple& face, Index a, Index b) {
  unsigned j = 0;
  while (face[next_corner[j]] != a || face[previous_corner[j]] != b) ++j;
  return j;
}

}  // namespace

Mesh link_faces(std::span<const Triple> faces, std::span<const Triple> neighbors,
                std::span<const Index> names) {
  Mesh mesh;
  mesh.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Face& face = mesh[mesh.add_face()];
    for (unsigned i = 0; i < 3; ++i) {
      face.vertex[i] = names[faces[f][i]];
      const Index g = neighbors[f][i];
      const unsigned edge =
          edge_between(faces[g], faces[f][previous_corner[i]], faces[f][next_corner[i]]);
      face.opposite[i] = halfedge(g, edge);
    }
  }
  return mesh;
}

}  // namespace rondel::topology
