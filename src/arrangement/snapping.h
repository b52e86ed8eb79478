// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One step of an arrangement: nodes are put where arcs cross, and arcs are led through the nodes
// that are near to them.
//
// in    arcs between nodes
// out   the pieces of the arcs, between more nodes
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "arrangement/noded_arcs.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

struct Snapped {
  NodedArcs pieces;
  // For each arc before the halfedges of its pieces, from its `from` to its `to`: 2 * piece, or 2 *
  // piece + 1 backwards. An arc that is a point has none.
  CompressedRows<Index> chains;
  // True if it is proved that the pieces do not cross and have no nodes within them; otherwise
  // another step has to look.
  bool is_certain = false;
};

// Returns nothing if no arcs cross and no node is within an arc. With `is_forced` arcs are led
// through the places of their crossings even where other nodes are as near.
std::optional<Snapped> snap(const NodedArcs& input, bool is_forced, unsigned threads);

// Points on different rays, along the spatial order, and the number of each given point among them.
// One of the first `num_fixed` points stands for all points on its ray; otherwise the point with the
// least coordinates does.
struct NumberedPoints {
  std::vector<Point> points;
  std::vector<Index> numbers;
};
NumberedPoints numbered(std::span<const Point> given, std::size_t num_fixed, unsigned threads);

// Returns the arcs between the nodes with these numbers, each once, and the halfedge of each.
struct NumberedArcs {
  std::vector<NodedArc> arcs;
  std::vector<Index> halfedges;
};
NumberedArcs numbered_arcs(std::span<const NodedArc> given, unsigned threads);

}  // namespace rondel::arrangement
