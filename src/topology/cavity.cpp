// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "topology/cavity.h"

namespace rondel::topology {

void star(Mesh& mesh, Index v, std::span<const HorizonEdge> horizon, std::vector<Index>& slots) {
  const std::size_t size = horizon.size();
  while (slots.size() < size) slots.push_back(mesh.add_face());
  while (slots.size() > size) {
    mesh.remove_face(slots.back());
    slots.pop_back();
  }
  Index before = slots[size - 1];
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t next = i + 1 < size ? i + 1 : 0;
    const Index f = slots[i];
    const Halfedge outside = horizon[i].outside;
    mesh[f] = {{v, horizon[i].origin, horizon[next].origin},
               {outside, halfedge(slots[next], 2), halfedge(before, 1)}};
    mesh[face_of(outside)].opposite[edge_of(outside)] = halfedge(f, 0);
    before = f;
  }
}

}  // namespace rondel::topology
