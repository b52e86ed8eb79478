// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the final faces of a block in canonical order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bulk/faces.h"
#include "bulk/plane_graph.h"

namespace rondel::bulk {

// Arrays that one block after the other uses.
struct EmissionSpace {
  // The final faces that a site owns: those of which it is the corner with the lowest rank.
  struct Owned {
    std::uint64_t first;  // second corner, the smallest one, and halfedge to it, which is the key
    Index count;
    Index seam;  // the place of a seam site in the result
  };
  std::vector<Owned> owned;
  std::vector<Index> owners;
};

// The sites of a graph have the ranks first, first + 1, ..., and perhaps names that are not ranks.
struct EmittedSites {
  Index first;
  Index num;
  std::span<const Index> names;
};

// The graph names the open faces (open_faces.h) and no others; `open` lists the halfedges with an
// open face on their left, `hidden` the sites without edges. Names all faces in the graph. Corners
// are written as ranks or, if sites have names, by these. Precondition: less than 2^28 sites.
void emit_faces(PlaneGraph& graph, const EmittedSites& sites,
                const std::vector<PlaneGraph::Edge>& open, const std::vector<Index>& hidden,
                EmissionSpace& space, const FaceStore& store, BlockResult& result);

}  // namespace rondel::bulk
