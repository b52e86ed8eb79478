// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "topology/cavity.h"

namespace rondel::topology {

std::pair<Index, Index> flat_pair(Mesh& mesh, const std::array<Index, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Index top = mesh.add_face();
  const Index bottom = mesh.add_face();
  mesh[top].vertex = {a, b, c};
  mesh[bottom].vertex = {a, c, b};
  mesh.link(halfedge(top, 0), halfedge(bottom, 0));
  mesh.link(halfedge(top, 1), halfedge(bottom, 2));
  mesh.link(halfedge(top, 2), halfedge(bottom, 1));
  return {top, bottom};
}

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
