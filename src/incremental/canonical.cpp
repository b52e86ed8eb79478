// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "incremental/canonical.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "blocks/prefetch.h"
#include "system/huge_pages.h"

namespace rondel::incremental {
namespace {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::Mesh;
using topology::next_corner;

// Without branches: nothing predicts the answer.
unsigned first_corner(const topology::Face& face) {
  const auto& v = face.vertex;
  const auto i = static_cast<unsigned>(v[1] < v[0]);
  return v[2] < std::min(v[0], v[1]) ? 2 : i;
}

Index owner(const topology::Face& face) {
  return std::min({face.vertex[0], face.vertex[1], face.vertex[2]});
}

// Lists the faces of the owner of faces[0] in their order around it, from that one on.
void walk_around(const Mesh& mesh, std::span<Halfedge> faces) {
  Halfedge h = faces[0];
  const Index owner = mesh[face_of(h)].vertex[edge_of(h)];
  for (std::size_t found = 0; found < faces.size();) {
    const topology::Face& face = mesh[face_of(h)];
    if (face.vertex[first_corner(face)] == owner) faces[found++] = h;
    h = mesh.next_around(face_of(h), edge_of(h));
  }
}

// Sorts the faces of one owner, given as 3*face + corner. Where each face meets the one before,
// which is usual, their corners tell; otherwise a walk around the owner.
void sort_around(const Mesh& mesh, std::span<Halfedge> faces) {
  const auto vertex = [&mesh](Halfedge h, unsigned step) {
    return mesh[face_of(h)].vertex[(edge_of(h) + step) % 3];
  };
  std::iter_swap(faces.begin(), std::ranges::min_element(
                                    faces, {}, [&vertex](Halfedge h) { return vertex(h, 1); }));
  if (faces.size() == 2) return;
  // Looking for the next face is quadratic in their number, the walk linear in the owner's degree.
  constexpr std::size_t many = 16;
  if (faces.size() > many) {
    walk_around(mesh, faces);
    return;
  }
  for (std::size_t i = 1; i < faces.size(); ++i) {
    const Index shared = vertex(faces[i - 1], 2);
    const auto next = std::find_if(faces.begin() + static_cast<std::ptrdiff_t>(i), faces.end(),
                                   [&](Halfedge h) { return vertex(h, 1) == shared; });
    if (next == faces.end()) {
      walk_around(mesh, faces);
      return;
    }
    std::iter_swap(faces.begin() + static_cast<std::ptrdiff_t>(i), next);
  }
}

}  // namespace

std::vector<Halfedge> canonical_order(const Mesh& mesh, Index num_ranks,
                                      std::vector<Index> scratch) {
  std::vector<Index>& end = scratch;
  end.assign(num_ranks, 0);
  const Index num_slots = mesh.num_slots();
  const auto prefetch_end = [&](Index f) {
    if (f < num_slots) blocks::prefetch(&end[std::min(owner(mesh[f]), num_ranks - 1)]);
  };
  for (Index f = 0; f < num_slots; ++f) {
    prefetch_end(f + blocks::prefetch_distance);
    if (mesh.is_alive(f)) ++end[owner(mesh[f])];
  }
  Index sum = 0;
  for (Index& e : end) sum += std::exchange(e, sum);

  std::vector<Halfedge> order;
  system::reserve_large(order, mesh.num_faces());
  order.resize(mesh.num_faces());
  for (Index f = 0; f < num_slots; ++f) {
    prefetch_end(f + blocks::prefetch_distance);
    if (mesh.is_alive(f)) order[end[owner(mesh[f])]++] = halfedge(f, first_corner(mesh[f]));
  }
  Index begin = 0;
  for (Index rank = 0; rank < num_ranks; ++rank) {
    const Index ahead = begin + blocks::prefetch_distance;
    if (ahead < order.size()) blocks::prefetch(&mesh[face_of(order[ahead])]);
    const Index count = end[rank] - begin;
    if (count > 1) sort_around(mesh, {&order[begin], count});
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
  system::reserve_large(arrays.faces, order.size());
  arrays.faces.resize(order.size());
  const auto prefetch_face = [&](std::size_t i) {
    if (i < order.size()) blocks::prefetch(&mesh[face_of(order[i])]);
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    prefetch_face(i + blocks::prefetch_distance);
    auto& vertex = mesh[face_of(order[i])].vertex;
    arrays.faces[i] = rotated(vertex, edge_of(order[i]));
    for (Index& v : arrays.faces[i]) v = names[v];
    vertex[0] = static_cast<Index>(i);
  }
  system::reserve_large(arrays.neighbors, order.size());
  arrays.neighbors.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    prefetch_face(i + blocks::prefetch_distance);
    const auto& opposite = mesh[face_of(order[i])].opposite;
    arrays.neighbors[i] = rotated(opposite, edge_of(order[i]));
    for (Index& g : arrays.neighbors[i]) g = mesh[face_of(g)].vertex[0];
  }
}

}  // namespace rondel::incremental
