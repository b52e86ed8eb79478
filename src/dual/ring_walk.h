// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Names and steps around the corners of faces.
//
//        v0            Halfedge 3f + i is the edge of face f opposite to corner i; it
//       /  \           runs from corner i+1 to corner i+2 with f on its left.
//      / f  \          The faces around a vertex v in counterclockwise order: leave f
//    v1 ---- v2        across the edge from v to the corner that follows second.
#pragma once

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::dual {

// Without branches, which would be mispredicted: 2-bit tables of (1, 2, 0) and (2, 0, 1).
constexpr Index next_corner(Index i) { return (0b001001U >> (2 * i)) & 3U; }
constexpr Index previous_corner(Index i) { return (0b010010U >> (2 * i)) & 3U; }

// Precondition: v is a corner of the face.
inline Index corner_of(const Triple& face, Index v) {
  return static_cast<Index>(face[1] == v) | (static_cast<Index>(face[2] == v) << 1);
}

// The corner that is neither v nor w.
inline Index third_corner(const Triple& face, Index v, Index w) {
  return face[0] ^ face[1] ^ face[2] ^ v ^ w;
}

// The corner of the face g across halfedge (f, i) that is opposite to this edge, too.
inline Index mirror_corner(const Triple& face, Index i, const Triple& across) {
  return next_corner(corner_of(across, face[next_corner(i)]));
}

}  // namespace rondel::dual
