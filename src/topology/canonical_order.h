// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The canonical order of the faces of a result, which depends on the surface alone, not on how it
// was built:
//
// 1. A face belongs to its owner, the corner of smallest rank, and starts with it.
// 2. Faces come by their owners.
// 3. The faces of one owner follow each other counterclockwise around it, not counting the faces of
//    others between them, and start with the one whose second corner has the smallest rank.
//
// It is written from a mesh (kernel/canonical.cpp), from the graph of a block (bulk/emit.cpp), and
// from the faces of blocks and of the seam between them (bulk/stitch.cpp).
#pragma once

#include <algorithm>
#include <array>

#include "rondel/types.h"

namespace rondel::topology {

// The corner, 0 to 2, that a face with corners of these ranks starts with. Without branches: nothing
// predicts the answer.
inline unsigned first_corner(const std::array<Index, 3>& ranks) {
  const auto i = static_cast<unsigned>(ranks[1] < ranks[0]);
  return ranks[2] < std::min(ranks[0], ranks[1]) ? 2 : i;
}

// Where, among the faces of one owner, the one is that they start with. second(face) is the rank of
// the second corner of a face.
template <class Faces, class Second>
auto find_first(Faces& faces, Second second) {
  return std::ranges::min_element(faces, {}, second);
}

// Turns the faces of one owner, listed counterclockwise from any of them, so that they start as they
// must.
template <class Faces, class Second>
void start_with_first(Faces& faces, Second second) {
  std::rotate(faces.begin(), find_first(faces, second), faces.end());
}

}  // namespace rondel::topology
