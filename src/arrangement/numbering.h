// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers of nodes along the spatial order, and of arcs by their nodes.
//
// in    points, arcs between nodes
// out   each node and each arc once, and the numbers of the given ones among them
// index what is given, and numbers
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "arrangement/noded_arcs.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Points on different rays, along the spatial order, and the number of each given point among them.
// One of the first `num_fixed` points stands for all points on its ray; otherwise the point with the
// least coordinates does.
struct NumberedPoints {
  std::vector<Point> points;
  std::vector<Index> numbers;
  std::vector<Index> sources;  // for each of `points` the given point with its coordinates
};
NumberedPoints numbered(std::span<const Point> given, std::size_t num_fixed, unsigned threads);

// Returns the arcs between nodes, each once, and the halfedge of each.
struct NumberedArcs {
  std::vector<NodedArc> arcs;
  std::vector<Index> halfedges;
};
NumberedArcs numbered_arcs(std::span<const NodedArc> given, std::size_t num_nodes,
                           unsigned threads);

}  // namespace rondel::arrangement
