// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of one block, on their way to the result.
//
// A block with the ranks begin ... end-1 has less than 2 (end - begin) - 4 final faces. They
// get the preliminary names 2 begin, 2 begin + 1, ..., in canonical order as far as they go. The
// seam is what the blocks leave open: its sites are triangulated by themselves.
#pragma once

#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::bulk {

// Where preliminary faces are written, all blocks together: corners are ranks, a neighbor is the
// preliminary name across the edge opposite to the corner, or no_index at the seam.
struct FaceStore {
  std::span<Triple> corners;
  std::span<Triple> neighbors;
};

// A site with a face that is not final, and its own final faces: those that it owns have the
// preliminary names faces_begin ... faces_end-1.
struct SeamSite {
  Index rank;
  Index faces_begin;
  Index faces_end;
};

// The edge from seam site a to seam site b has the final face `face` on its left, opposite to
// corner `corner` of it, and the seam on its right. Sites are positions in the list of seam sites.
struct SeamEdge {
  Index a;
  Index b;
  Index face;
  unsigned corner;
};

struct BlockResult {
  Index faces_begin = 0;
  Index faces_end = 0;
  std::vector<SeamSite> seam_sites;  // in increasing order of rank
  std::vector<SeamEdge> seam_edges;
  Tally tally;
};

}  // namespace rondel::bulk
