// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/plane_graph.h"

namespace rondel::bulk {

std::vector<Index> remove_unreached(PlaneGraph& graph, PlaneGraph::Edge start, Index num_vertices) {
  std::vector<bool> is_reached(num_vertices, false);
  std::vector<PlaneGraph::Edge> stack = {start};
  is_reached[graph.origin(start)] = true;
  while (!stack.empty()) {
    const PlaneGraph::Edge first = stack.back();
    stack.pop_back();
    PlaneGraph::Edge e = first;
    do {
      if (!is_reached[graph.target(e)]) {
        is_reached[graph.target(e)] = true;
        stack.push_back(e ^ 1);
      }
      e = graph.next(e);
    } while (e != first);
  }
  std::vector<Index> unreached;
  for (Index i = 0; i < num_vertices; ++i) {
    if (!is_reached[i]) unreached.push_back(i);
  }
  for (PlaneGraph::Edge e = 0; e < graph.edge_limit(); e += 2) {
    if (graph.is_alive(e) && !is_reached[graph.origin(e)]) graph.remove(e);
  }
  return unreached;
}

}  // namespace rondel::bulk
