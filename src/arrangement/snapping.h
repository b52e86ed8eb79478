// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One step of an arrangement: nodes are put where arcs cross, and arcs are led through the nodes
// that are near to them.
//
// in    arcs between nodes
// out   the pieces of the arcs, between more nodes
#pragma once

#include <optional>

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

}  // namespace rondel::arrangement
