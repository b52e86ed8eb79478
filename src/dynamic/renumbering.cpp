// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dynamic/renumbering.h"

#include <algorithm>
#include <utility>

#include "system/prefetch.h"

namespace rondel::dynamic {

Renumbering::Renumbering(std::vector<Index> old_places, Index place_limit)
    : old_place(std::move(old_places)), new_place(place_limit, no_index) {
  for (Index i = 0; i < old_place.size(); ++i) new_place[old_place[i]] = i;
}

RenumberedMesh renumber(const topology::Mesh& mesh, const Renumbering& places) {
  const auto min_vertex = [&](Index f) {
    const auto& v = mesh[f].vertex;
    return std::min({places.new_place[v[0]], places.new_place[v[1]], places.new_place[v[2]]});
  };
  // Sorted by counting: begin[v] becomes the first number of the faces of v, and then, while they
  // are numbered, the next one.
  std::vector<Index> begin(places.old_place.size() + 1, 0);
  std::vector<Index> least(mesh.num_slots(), no_index);
  mesh.for_each_face([&](Index f) {
    least[f] = min_vertex(f);
    ++begin[least[f] + std::size_t{1}];
  });
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<Index> old_face(mesh.num_faces());
  std::vector<Index> new_face = std::move(least);
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    if (new_face[f] == no_index) continue;
    new_face[f] = begin[new_face[f]]++;
    old_face[new_face[f]] = f;
  }
  topology::Mesh result;
  result.reserve(2 * places.room());
  for (std::size_t i = 0; i < old_face.size(); ++i) {
    if (i + system::prefetch_distance < old_face.size()) {
      system::prefetch(&mesh[old_face[i + system::prefetch_distance]]);
    }
    topology::Face face = mesh[old_face[i]];
    for (Index& v : face.vertex) v = places.new_place[v];
    for (topology::Halfedge& h : face.opposite) {
      h = topology::halfedge(new_face[topology::face_of(h)], topology::edge_of(h));
    }
    result[result.add_face()] = face;
  }
  return {std::move(result), std::move(new_face)};
}

}  // namespace rondel::dynamic
