// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces on the border that are flat by rounding. Sites of one great circle are rounded, so that some
// lie 1e-16 inside of an edge between others:
//
//     a ------------------------------------ b     outside, or another flat face
//        -- c1 ------- c2 -------- c3 -----       1e-16 below
//
// Interpolation between a, b and a corner between them would take values from far away, where c1 and
// c2 are near. So a target in such a face is taken to be on an edge of the chain a c1 c2 c3 b, which
// has the other faces on its inside. It is moved by less than the rounding of the sites.
//
// Inner faces are never flat: the circle of a flat face is nearly a great circle, and has no site
// inside.
//
// in    the mesh of a triangulation, the unit vectors of its vertices; located targets
// out   their locations, with edges in the place of flat faces
// index faces of the mesh, spatial ranks of vertices
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "exact/unit_vector.h"
#include "interpolation/row.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "topology/mesh.h"

namespace rondel::interpolation {

// The height of a flat face above its longest side is at most this. Sites on a great circle that are
// off by up to 2^-50, eight times the rounding of a unit vector, have faces of twice that height.
inline constexpr double max_flat_height = 0x1p-49;
// The sides of a flat face are longer than this: a smaller face is as wide as it is high, or joins
// sites that are next to each other.
inline constexpr double min_flat_side = 0x1p-29;

// Returns the flat faces of a triangulation of dimension 2 or less, in ascending order. Precondition: the
// projected model.
std::vector<Index> flat_faces_of(const Triangulation& triangulation);

class FlatFaces {
 public:
  // Refers to the triangulation, its mesh and the unit vectors. Precondition: dimension 2, the projected
  // model.
  FlatFaces(const Triangulation& triangulation, const topology::Mesh& mesh,
            std::span<const exact::SplitPoint> units);
  FlatFaces() = default;  // no faces

  // True where no target moves.
  [[nodiscard]] bool empty() const { return are_flat_.empty(); }
  [[nodiscard]] bool contains(Index face) const { return !empty() && are_flat_[face]; }

  // Returns the location of a target that is no vertex: an edge of the chain for a target in a flat
  // face or on its sides. The face of such an edge is the one on its inside, or a flat one where
  // there is no other. Other locations stay.
  [[nodiscard]] Location location_of(const LocatedTarget& place) const {
    const Index face = place.location.face;
    return face != no_index && contains(face) ? on_chain(face, place.unit) : place.location;
  }
  // Returns the same also for a target inside of the chain that is beside it within the height of a
  // flat face: the circle of one may have it, and then the cell that the target would have has a
  // part of the cells of sites far away.
  [[nodiscard]] Location location_beside(const LocatedTarget& place) const;

 private:
  // Returns the longest side of a face that is flat by its shape, wherever it is.
  [[nodiscard]] std::optional<unsigned> flat_side(Index face) const;
  [[nodiscard]] std::array<exact::SplitPoint, 3> corners_of(Index face) const;
  // Returns the edge of the chain that is beside a target in a flat face.
  [[nodiscard]] Location on_chain(Index face, const exact::SplitPoint& unit) const;
  [[nodiscard]] Location on_edge(Index face, unsigned edge) const;
  // Returns the edge of a face that has a flat face behind it and the target at most that far from
  // it.
  [[nodiscard]] std::optional<unsigned> edge_beside(Index face,
                                                    const exact::SplitPoint& unit) const;

  const Triangulation* triangulation_ = nullptr;
  const topology::Mesh* mesh_ = nullptr;
  std::span<const exact::SplitPoint> units_;
  std::vector<bool> are_flat_;  // by face; empty if none is
};

}  // namespace rondel::interpolation
