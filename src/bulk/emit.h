// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the final faces of a block in canonical order.
//
// in    a graph in which the open faces are named
// out   faces and their neighbors, and what is left to the seam
// index local sites in the graph; ranks, or names, in faces; preliminary names of faces
//
// A block with the ranks begin ... end-1 has less than 2 (end - begin) - 4 final faces. They
// get the preliminary names 2 begin, 2 begin + 1, ..., in canonical order as far as they go. The
// seam is what the blocks leave open: its sites are triangulated by themselves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bulk/plane_graph.h"
#include "rondel/triangulation.h"

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
  std::vector<Index> hidden;  // seam sites without edges, by their position in the list
  Tally tally;
};

// Arrays that one block after the other uses.
struct EmissionSpace {
  // The final faces that a site owns: those of which it is the corner with the lowest rank.
  struct Owned {
    std::uint64_t first;  // second corner, the smallest one, and halfedge to it, which is the key
    Index count;
    Index seam;  // the place of a seam site in the result
  };
  // A site that owns faces: before those of the next owner, whose first one is the face `end`.
  struct Owner {
    std::uint64_t first;
    Index site;
    Index end;
  };
  std::vector<Owned> owned;
  std::vector<Owner> owners;
};

// The sites of a graph have the ranks first, first + 1, ..., and perhaps names that are not ranks.
struct EmittedSites {
  Index first;
  Index num;
  std::span<const Index> names;
};

// The graph names the open faces (open_faces.h) and no others, or anything if none is open; `open`
// lists the halfedges with an open face on their left, `hidden` the sites without edges. Names all
// faces in the graph. Corners are written as ranks or, if sites have names, by these. Threads help
// where no face is open. Precondition: less than 2^28 sites.
void emit_faces(PlaneGraph& graph, const EmittedSites& sites,
                const std::vector<PlaneGraph::Edge>& open, const std::vector<Index>& hidden,
                EmissionSpace& space, const FaceStore& store, BlockResult& result,
                unsigned threads = 1);

}  // namespace rondel::bulk
