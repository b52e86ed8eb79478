// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "kernel/canonical.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "system/large_arrays.h"
#include "system/prefetch.h"
#include "topology/canonical_order.h"

namespace rondel::kernel {
namespace {

using topology::edge_of;
using topology::face_of;
using topology::Halfedge;
using topology::halfedge;
using topology::Mesh;
using topology::next_corner;

unsigned first_corner(const topology::Face& face) { return topology::first_corner(face.vertex); }

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

// The faces of one owner, given as 3*face + corner, with their other corners.
class OwnedFaces {
 public:
  explicit OwnedFaces(const Mesh& mesh) : mesh_(mesh) {}

  // Sorts them. Where each face meets the one before, which is usual, their corners tell; otherwise
  // a walk around the owner.
  void sort(std::span<Halfedge> faces) {
    // Looking for the next face is quadratic in their number, the walk linear in the owner's
    // degree.
    if (faces.size() > many || !chain(faces)) {
      const auto second = [this](Halfedge h) {
        return mesh_[face_of(h)].vertex[next_corner[edge_of(h)]];
      };
      std::iter_swap(faces.begin(), topology::find_first(faces, second));
      walk_around(mesh_, faces);
    }
  }

 private:
  static constexpr std::size_t many = 16;

  bool chain(std::span<Halfedge> faces) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto& v = mesh_[face_of(faces[i])].vertex;
      const unsigned b = next_corner[edge_of(faces[i])];
      second_[i] = v[b];
      third_[i] = v[next_corner[b]];
      if (second_[i] < second_[first]) first = i;
    }
    move_to(faces, 0, first);
    if (faces.size() == 2) return true;
    for (std::size_t i = 1; i < faces.size(); ++i) {
      std::size_t next = i;
      while (next < faces.size() && second_[next] != third_[i - 1]) ++next;
      if (next == faces.size()) return false;
      move_to(faces, i, next);
    }
    return true;
  }

  void move_to(std::span<Halfedge> faces, std::size_t i, std::size_t j) {
    std::swap(faces[i], faces[j]);
    std::swap(second_[i], second_[j]);
    std::swap(third_[i], third_[j]);
  }

  const Mesh& mesh_;
  std::array<Index, many> second_{};
  std::array<Index, many> third_{};
};

// For each rank, where its faces end in the order; then the faces themselves.
std::vector<Halfedge> faces_by_owner(const Mesh& mesh, std::vector<Index>& end) {
  const Index num_slots = mesh.num_slots();
  const auto last_rank = static_cast<Index>(end.size() - 1);
  const auto prefetch_end = [&](Index f) {
    if (f < num_slots) system::prefetch(&end[std::min(owner(mesh[f]), last_rank)]);
  };
  for (Index f = 0; f < num_slots; ++f) {
    prefetch_end(f + system::prefetch_distance);
    if (mesh.is_alive(f)) ++end[owner(mesh[f])];
  }
  Index sum = 0;
  for (Index& e : end) sum += std::exchange(e, sum);

  std::vector<Halfedge> order;
  system::reserve_large(order, mesh.num_faces());
  order.resize(mesh.num_faces());
  for (Index f = 0; f < num_slots; ++f) {
    prefetch_end(f + system::prefetch_distance);
    if (mesh.is_alive(f)) order[end[owner(mesh[f])]++] = halfedge(f, first_corner(mesh[f]));
  }
  return order;
}

// Sorts the faces of each owner and writes them.
void write_faces(const Mesh& mesh, std::vector<Halfedge>& order, const std::vector<Index>& end,
                 const std::vector<Index>& names, LargeVector<Triple>& faces) {
  faces.reserve(order.size());
  OwnedFaces owned(mesh);
  Index begin = 0;
  for (Index rank = 0; rank < end.size(); ++rank) {
    if (end[rank] - begin > 1) owned.sort({&order[begin], end[rank] - begin});
    for (; begin < end[rank]; ++begin) {
      const Index ahead = begin + system::prefetch_distance;
      if (ahead < order.size()) system::prefetch(&mesh[face_of(order[ahead])]);
      const auto& v = mesh[face_of(order[begin])].vertex;
      const unsigned b = next_corner[edge_of(order[begin])];
      faces.push_back({names[rank], names[v[b]], names[v[next_corner[b]]]});
    }
  }
}

}  // namespace

void write_canonical(Mesh& mesh, const std::vector<Index>& names, std::vector<Index> scratch,
                     TriangulationArrays& arrays) {
  scratch.assign(names.size(), 0);
  std::vector<Halfedge> order = faces_by_owner(mesh, scratch);
  write_faces(mesh, order, scratch, names, arrays.faces);

  const auto prefetch_face = [&](std::size_t i) {
    if (i < order.size()) system::prefetch(&mesh[face_of(order[i])]);
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    prefetch_face(i + system::prefetch_distance);
    mesh[face_of(order[i])].vertex[0] = static_cast<Index>(i);
  }
  arrays.neighbors.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    prefetch_face(i + system::prefetch_distance);
    const auto& opposite = mesh[face_of(order[i])].opposite;
    const unsigned a = edge_of(order[i]);
    const unsigned b = next_corner[a];
    const auto place = [&mesh](Halfedge h) { return mesh[face_of(h)].vertex[0]; };
    arrays.neighbors.push_back(
        {place(opposite[a]), place(opposite[b]), place(opposite[next_corner[b]])});
  }
}

void report_ghosts(const topology::Mesh& mesh, const FaceKinds& kinds, std::vector<Index>& ghosts) {
  if (kinds.all_solid()) return;
  mesh.for_each_face([&](Index f) {
    if (kinds[f] != FaceKind::solid) ghosts.push_back(mesh[f].vertex[0]);
  });
  std::ranges::sort(ghosts);
}

}  // namespace rondel::kernel
