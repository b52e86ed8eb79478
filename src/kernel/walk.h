// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Point location by walks on the hull, as it is seen from the center o of the sphere.
//
// A ray from o leaves the hull through a solid face (o strictly below it). The solid faces
// triangulate a convex cone of directions: all of space when o is strictly inside the hull;
// otherwise the cone ends at the contour, and the ray enters the hull through an entry face
// (o strictly above it). Grazing faces have o in their plane.
//
//          solid          p beyond a contour edge (a, b) of solid face f is outside
//       .---------.       of the wedge of the two faces at (a, b): f and its
//      /   hull    \      neighbor both have their third corner on the other side of
//      '-----------'      the plane (o, a, b). So p is in conflict with one of them.
//          entry
//            o            docs/theory/location.md has the proofs.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/conflict_test.h"
#include "predicates/orientation.h"
#include "system/prefetch.h"
#include "topology/mesh.h"

namespace rondel::kernel {

enum class FaceKind : std::uint8_t { solid, entry, grazing };

inline FaceKind kind_of(Sign orientation) {
  if (orientation == Sign::positive) return FaceKind::solid;
  return orientation == Sign::negative ? FaceKind::entry : FaceKind::grazing;
}

// The kinds of the faces. Most hulls have the center strictly inside, and then all faces are solid:
// so a kind is solid unless another one was added, and nothing is written, nor read, as long
// as there is nothing else.
class FaceKinds {
 public:
  [[nodiscard]] bool all_solid() const { return num_ghosts_ == 0; }
  [[nodiscard]] FaceKind operator[](Index f) const {
    return all_solid() || f >= kinds_.size() ? FaceKind::solid : kinds_[f];
  }
  void add(Index f, FaceKind kind) {
    if (kind == FaceKind::solid) return;
    if (f >= kinds_.size()) kinds_.resize(f + std::size_t{1}, FaceKind::solid);
    kinds_[f] = kind;
    ++num_ghosts_;
  }
  void remove(Index f) {
    if ((*this)[f] == FaceKind::solid) return;
    kinds_[f] = FaceKind::solid;
    --num_ghosts_;
  }

 private:
  std::vector<FaceKind> kinds_;
  std::size_t num_ghosts_ = 0;
};

template <models::SphereTraits T>
class Walk {
 public:
  Walk(ConflictTest<T>& test, const topology::Mesh& mesh, const FaceKinds& kinds)
      : test_(test), sites_(test.sites()), mesh_(mesh), kinds_(kinds) {}

  // Where p is. A hidden site has a solid face above it, and an entry face below it unless there
  // is none or its ray touches the hull in grazing faces only.
  struct Found {
    Index conflict = no_index;  // a face in conflict with p; none when p is hidden
    Index solid = no_index;
    Index entry = no_index;
  };

  // `solid` is a solid face near p, `entry` an entry face (no_index when there is none).
  [[nodiscard]] Found locate(Index p, Index solid, Index entry) const {
    const Index guess = walk_by_guess<FaceKind::solid>(p, solid);
    if (is_in_conflict(guess, p)) return {guess};
    const End far_side = walk(p, guess, FaceKind::solid);
    if (is_in_conflict(far_side.face, p)) return {far_side.face};
    if (far_side.beyond != no_index) return {far_side.beyond};
    if (!T::hides_sites || kinds_.all_solid() || entry == no_index) {
      return {no_index, far_side.face};
    }
    const End entry_side = walk(p, walk_by_guess<FaceKind::entry>(p, entry), FaceKind::entry);
    if (is_in_conflict(entry_side.face, p)) return {entry_side.face};
    return {no_index, far_side.face, entry_side.beyond == no_index ? entry_side.face : no_index};
  }

  // The face that the ray of p leaves the hull through, or touches at the border of the face.
  // Precondition: all faces are solid, as `solid` is.
  [[nodiscard]] Index face_on_ray(Index p, Index solid) const {
    return walk(p, walk_by_guess<FaceKind::solid>(p, solid), FaceKind::solid).face;
  }

 private:
  struct End {
    Index face;
    Index beyond = no_index;  // the face across the contour, when the walk ended there
  };

  [[nodiscard, gnu::always_inline]] bool is_in_conflict(Index f, Index p) const {
    return test_.is_in_conflict(mesh_[f].vertex, p);
  }

  // A visibility walk in doubles among the faces of one kind, which crosses an edge only where p is
  // beyond it for certain. So its steps are some of the exact walk's, and it ends. It may end too
  // early: then the exact walk goes on.
  template <FaceKind kind>
  [[nodiscard]] Index walk_by_guess(Index p, Index f) const {
    using predicates::Vector;
    const Vector origin = sites_.coordinates(p);
    const Vector ray = sites_.from_center(p);
    unsigned entered = 3;
    for (;;) {
      const topology::Face& face = mesh_[f];
      for (const topology::Halfedge h : face.opposite)
        system::prefetch(&mesh_[topology::face_of(h)]);
      const std::array<Vector, 3> to = {sites_.coordinates(face.vertex[0]) - origin,
                                        sites_.coordinates(face.vertex[1]) - origin,
                                        sites_.coordinates(face.vertex[2]) - origin};
      unsigned i = 0;
      for (; i < 3; ++i) {
        if (i == entered) continue;
        const Vector& a = to[topology::next_corner[i]];
        const Vector& b = to[topology::previous_corner[i]];
        const double value = dot(ray, cross(a, b));
        const bool is_outwards = kind == FaceKind::solid ? value < 0 : value > 0;
        if (is_outwards && is_certain(value, ray, a, b)) break;
      }
      if (i == 3) return f;
      const topology::Halfedge h = face.opposite[i];
      const Index next = topology::face_of(h);
      if (!kinds_.all_solid() && kinds_[next] != kind) return f;
      f = next;
      entered = topology::edge_of(h);
    }
  }

  // True if the sign of a determinant is certain: of a ray from the center to a site, and two steps
  // from that site.
  [[nodiscard]] static bool is_certain(double value, const predicates::Vector& ray,
                                       const predicates::Vector& a, const predicates::Vector& b) {
    return T::hides_sites
               ? predicates::is_orientation_certain(value, ray, a, b)
               : predicates::is_direction_orientation_certain(value, dot(a, a), dot(b, b));
  }

  // The exact walk among the faces of one kind, where p is not beyond the edge that was just
  // crossed. It ends: each step increases u.n/h, where u is the direction of p, n the normal of the
  // face and h > 0 its distance from the center (decreases it on the entry side).
  [[nodiscard]] End walk(Index p, Index f, FaceKind kind) const {
    const Sign outwards = kind == FaceKind::solid ? Sign::negative : Sign::positive;
    unsigned entered = 3;
    for (;;) {
      const topology::Face& face = mesh_[f];
      unsigned i = 0;
      for (; i < 3; ++i) {
        if (i == entered) continue;
        const unsigned a = topology::next_corner[i];
        const Index b = face.vertex[topology::next_corner[a]];
        if (predicates::orientation(sites_, face.vertex[a], b, p).sign == outwards) break;
      }
      if (i == 3) return {f};
      const topology::Halfedge h = face.opposite[i];
      const Index next = topology::face_of(h);
      if (kinds_[next] != kind) return {f, next};
      f = next;
      entered = topology::edge_of(h);
    }
  }

  ConflictTest<T>& test_;
  const T& sites_;
  const topology::Mesh& mesh_;
  const FaceKinds& kinds_;
};

}  // namespace rondel::kernel
