// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that no edge connects to the rest: hidden ones.
#pragma once

#include <vector>

#include "bulk/plane_graph.h"

namespace rondel::bulk {

// Lists the vertices without a path to this edge, and deletes their edges.
std::vector<Index> remove_unreached(PlaneGraph& graph, PlaneGraph::Edge start, Index num_vertices);

}  // namespace rondel::bulk
