// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where a direction is among the solid faces, by the walk that docs/theory/location.md proves, with
// exact orientations only; and the conflict region of a point.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "kernel/conflict_region.h"
#include "kernel/walk.h"
#include "query/graph.h"
#include "query/target.h"
#include "rondel/error.h"
#include "rondel/query.h"

namespace rondel::query {

// Returns the solid face with the smallest number among those at a vertex, or no_index.
template <models::SphereTraits T>
Index first_solid_face(const SurfaceGraph<T>& surface, Index v) {
  Index first = no_index;
  surface.visit_corners(v, [&](topology::Halfedge h) {
    const Index f = topology::face_of(h);
    if (surface.kinds[f] == kernel::FaceKind::solid) first = std::min(first, f);
    return false;
  });
  return first;
}

// Throws for viewed sites that were changed after the triangulation was made.
[[noreturn]] inline void refuse_sites() {
  throw InvalidInput("the sites are not those of the triangulation", 0);
}

// The query lies in the closed cone of the solid face f. `is_on[i]`: in the plane of edge i, which is
// so of all three only if the sites are not those that were triangulated.
template <models::SphereTraits T>
Location location_in(const SurfaceGraph<T>& surface, Index f, const std::array<bool, 3>& is_on) {
  const topology::Face& face = surface.mesh[f];
  const auto count = std::ranges::count(is_on, true);
  if (count == 0) return {Where::face, f, face.vertex};
  if (count == 1) {
    const auto i = static_cast<unsigned>(std::ranges::find(is_on, true) - is_on.begin());
    const unsigned a = topology::next_corner[i];
    const Index other = topology::face_of(face.opposite[i]);
    const bool is_shared = surface.kinds[other] == kernel::FaceKind::solid;
    return {Where::edge,
            is_shared ? std::min(f, other) : f,
            {face.vertex[a], face.vertex[topology::next_corner[a]], no_index}};
  }
  if (count == 3) refuse_sites();
  const auto i = static_cast<unsigned>(std::ranges::find(is_on, false) - is_on.begin());
  const Index v = face.vertex[i];
  return {Where::vertex, first_solid_face(surface, v), {v, no_index, no_index}};
}

// `f` is a solid face to start from, and becomes the one where the walk ends, which comes to no face
// twice, unless the sites are not those that were triangulated; then it throws InvalidInput at last.
template <models::SphereTraits T>
Location locate(const SurfaceGraph<T>& surface, const Target<T>& target, Index& f) {
  unsigned entered = 3;
  for (Index left = surface.mesh.num_slots(); left > 0; --left) {
    const topology::Face& face = surface.mesh[f];
    std::array<bool, 3> is_on{};
    unsigned i = 0;
    for (; i < 3; ++i) {
      if (i == entered) continue;
      const unsigned a = topology::next_corner[i];
      const Index b = face.vertex[topology::next_corner[a]];
      const Sign side = predicates::orientation(target, face.vertex[a], b, Target<T>::query).sign;
      if (side == Sign::negative) break;
      is_on[i] = side == Sign::zero;
    }
    if (i == 3) return location_in(surface, f, is_on);
    const topology::Halfedge h = face.opposite[i];
    const Index next = topology::face_of(h);
    if (surface.kinds[next] != kernel::FaceKind::solid) return {};
    f = next;
    entered = topology::edge_of(h);
  }
  refuse_sites();
}

// The faces in conflict with the target, in increasing order. `solid` is a solid face near it.
// Precondition, projected: the target is no duplicate.
template <models::SphereTraits T>
std::vector<Index> conflict_region(const SurfaceGraph<T>& surface, Target<T> target, Index solid) {
  kernel::ConflictTest<Target<T>> test(target);
  const kernel::Walk<Target<T>> walk(test, surface.mesh, surface.kinds);
  const Index start = walk.locate(Target<T>::query, solid, surface.entry_face).conflict;
  if (start == no_index) return {};
  kernel::ConflictRegion<Target<T>> region;
  region.find(test, surface.mesh, Target<T>::query, start);
  std::vector<Index> faces = std::move(region.faces());
  std::ranges::sort(faces);
  return faces;
}

}  // namespace rondel::query
