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

std::vector<Halfedge> canonical_order(const Mesh& mesh, Index num_ranks,
                                      std::vector<Index> scratch) {
  std::vector<Index>& end = scratch;
  end.assign(num_ranks, 0);
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    if (mesh.is_alive(f)) ++end[mesh[f].vertex[first_corner(mesh[f])]];
  }
  Index sum = 0;
  for (Index& e : end) sum += std::exchange(e, sum);

  std::vector<Halfedge> order(mesh.num_faces());
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    if (!mesh.is_alive(f)) continue;
    const unsigned corner = first_corner(mesh[f]);
    order[end[mesh[f].vertex[corner]]++] = halfedge(f, corner);
  }
  Index begin = 0;
  for (Index rank = 0; rank < num_ranks; ++rank) {
    const Index count = end[rank] - begin;
    if (count > 1) sort_around(mesh, &order[begin], count);
    begin = end[rank];
  }
  return order;
}

void write_canonical(Mesh& mesh, const std::vector<Halfedge>& order,
                     const std::vector<Index>& names, TriangulationArrays& arrays) {
  const auto rotated = [](const std::array<Index, 3>& values, unsigned a) {
    const unsigned b = next_corner[a];
    return Triple{values[a], values[b], values[next_corner[b]]};
  };
  arrays.faces.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    auto& vertex = mesh[face_of(order[i])].vertex;
    arrays.faces[i] = rotated(vertex, edge_of(order[i]));
    for (Index& v : arrays.faces[i]) v = names[v];
    vertex[0] = static_cast<Index>(i);
  }
  arrays.neighbors.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& opposite = mesh[face_of(order[i])].opposite;
    arrays.neighbors[i] = rotated(opposite, edge_of(order[i]));
    for (Index& g : arrays.neighbors[i]) g = mesh[face_of(g)].vertex[0];
  }
}

}  // namespace rondel::incremental
