// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes the final faces of a block in canonical order.
#pragma once

#include <vector>

#include "bulk/faces.h"
#include "bulk/plane_graph.h"

namespace rondel::bulk {

// Arrays that one block after the other uses.
struct EmissionSpace {
  std::vector<PlaneGraph::Edge> edge_at;
  std::vector<Index> seam_index;
};

// The graph of the block with the ranks first ... first + num_sites - 1. It names the open faces
// (open_faces.h) and no others; `open` lists the halfedges with an open face on their left. Sites
// without edges belong to the seam. Names all faces in the graph.
void emit_faces(PlaneGraph& graph, Index first, Index num_sites,
                const std::vector<PlaneGraph::Edge>& open, EmissionSpace& space,
                const FaceStore& store, BlockResult& result);

}  // namespace rondel::bulk
