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
#include "query/surface.h"
#include "query/target.h"
#include "rondel/error.h"
#include "rondel/query.h"

namespace rondel::query {

// A place among internal names: `last_face` is where the next walk may start.
struct Place {
  Where where = Where::outside;
  std::array<Index, 3> vertices = {no_index, no_index, no_index};
  Index face = no_index;
  Index last_face = no_index;
};

// Of the solid faces that share a vertex, the one of the smallest number.
template <models::SphereTraits T>
Index first_solid_face(const Surface<T>& surface, Index v) {
  Index first = no_index;
  surface.visit_corners(v, [&](topology::Halfedge h) {
    const Index f = topology::face_of(h);
    if (surface.kinds[f] == kernel::FaceKind::solid) first = std::min(first, f);
    return false;
  });
  return first;
}

// The query lies in the closed cone of the solid face f. `is_on[i]`: in the plane of edge i.
template <models::SphereTraits T>
Place place_in(const Surface<T>& surface, Index f, const std::array<bool, 3>& is_on) {
  const topology::Face& face = surface.mesh[f];
  const auto count = std::ranges::count(is_on, true);
  if (count == 0) return {Where::face, face.vertex, f, f};
  if (count == 1) {
    const auto i = static_cast<unsigned>(std::ranges::find(is_on, true) - is_on.begin());
    const unsigned a = topology::next_corner[i];
    const Index other = topology::face_of(face.opposite[i]);
    const bool is_shared = surface.kinds[other] == kernel::FaceKind::solid;
    return {Where::edge,
            {face.vertex[a], face.vertex[topology::next_corner[a]], no_index},
            is_shared ? std::min(f, other) : f,
            f};
  }
  const auto i = static_cast<unsigned>(std::ranges::find(is_on, false) - is_on.begin());
  const Index v = face.vertex[i];
  return {Where::vertex, {v, no_index, no_index}, first_solid_face(surface, v), f};
}

// `start` is a solid face. The walk comes to no face twice, unless the sites are not those that
// were triangulated; then it throws InvalidInput at last.
template <models::SphereTraits T>
Place locate(const Surface<T>& surface, const Target<T>& target, Index start) {
  Index f = start;
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
    if (i == 3) return place_in(surface, f, is_on);
    const topology::Halfedge h = face.opposite[i];
    const Index next = topology::face_of(h);
    if (surface.kinds[next] != kernel::FaceKind::solid) {
      Place outside;
      outside.last_face = f;
      return outside;
    }
    f = next;
    entered = topology::edge_of(h);
  }
  throw InvalidInput("the sites are not those of the triangulation", 0);
}

// The faces in conflict with the target, in increasing order. `solid` is a solid face near it,
// `entry` an entry face if there is one. Precondition, projected: the target is no duplicate.
template <models::SphereTraits T>
std::vector<Index> conflict_region(const Surface<T>& surface, Target<T>& target, Index solid,
                                   Index entry) {
  kernel::ConflictTest<Target<T>> test(target);
  const kernel::Walk<Target<T>> location(test, surface.mesh, surface.kinds);
  const Index start = location.locate(Target<T>::query, solid, entry).conflict;
  if (start == no_index) return {};
  kernel::ConflictRegion<Target<T>> region;
  region.find(test, surface.mesh, Target<T>::query, start);
  std::vector<Index> faces = std::move(region.faces());
  std::ranges::sort(faces);
  return faces;
}

}  // namespace rondel::query
