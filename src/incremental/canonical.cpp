// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "incremental/canonical.h"

#include <algorithm>
#include <utility>

namespace rondel::incremental {
namespace {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::Mesh;
using topology::next_corner;

unsigned first_corner(const topology::Face& face) {
  const auto& v = face.vertex;
  const unsigned i = v[0] < v[1] ? 0 : 1;
  return v[i] < v[2] ? i : 2;
}

// Sorts the faces of one owner, given as 3*face + corner: walks around the owner from
// the face that comes first until all have been met.
void sort_around(const Mesh& mesh, Index* first, Index count) {
  const auto second_vertex = [&mesh](Halfedge h) {
    return mesh[face_of(h)].vertex[next_corner[edge_of(h)]];
  };
  Index* start = std::min_element(first, first + count, [&](Halfedge g, Halfedge h) {
    return second_vertex(g) < second_vertex(h);
  });
  Halfedge h = *start;
  const Index owner = mesh[face_of(h)].vertex[edge_of(h)];
  for (Index found = 0;;) {
    const auto& face = mesh[face_of(h)];
    if (face.vertex[first_corner(face)] == owner) first[found++] = h;
    if (found == count) return;
    h = mesh.next_around(face_of(h), edge_of(h));
  }
}

}  // namespace

CanonicalOrder canonical_order(const Mesh& mesh, Index num_ranks) {
  std::vector<Index> end(static_cast<std::size_t>(num_ranks) + 1, 0);
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    if (mesh.is_alive(f)) ++end[mesh[f].vertex[first_corner(mesh[f])]];
  }
  Index sum = 0;
  for (Index& e : end) sum += std::exchange(e, sum);

  CanonicalOrder result;
  result.corners.resize(mesh.num_faces());
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    if (!mesh.is_alive(f)) continue;
    const unsigned corner = first_corner(mesh[f]);
    result.corners[end[mesh[f].vertex[corner]]++] = halfedge(f, corner);
  }
  Index begin = 0;
  for (Index rank = 0; rank < num_ranks; ++rank) {
    const Index count = end[rank] - begin;
    if (count > 1) sort_around(mesh, &result.corners[begin], count);
    begin = end[rank];
  }
  result.place.assign(mesh.num_slots(), no_index);
  for (Index i = 0; i < mesh.num_faces(); ++i) result.place[face_of(result.corners[i])] = i;
  return result;
}

void write_canonical(const Mesh& mesh, const CanonicalOrder& order, const std::vector<Index>& names,
                     TriangulationArrays& arrays) {
  const auto rotated = [&order](Index i, const std::array<Index, 3>& values) {
    const unsigned a = edge_of(order.corners[i]);
    const unsigned b = next_corner[a];
    return Triple{values[a], values[b], values[next_corner[b]]};
  };
  const Index m = mesh.num_faces();
  arrays.faces.resize(m);
  arrays.neighbors.resize(m);
  for (Index i = 0; i < m; ++i) {
    const topology::Face& face = mesh[face_of(order.corners[i])];
    arrays.faces[i] = rotated(i, face.vertex);
    arrays.neighbors[i] = rotated(i, face.opposite);
    for (Index& v : arrays.faces[i]) v = names[v];
    for (Index& g : arrays.neighbors[i]) g = order.place[face_of(g)];
  }
}

}  // namespace rondel::incremental
