// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The nodes through which an arc is led.
//
// in    an arc, and the nodes near to it
// out   nodes in their order along the arc
// index nodes
#pragma once

#include <span>
#include <vector>

#include "arrangement/noded_arcs.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Appends the nodes that divide the arc, without its ends: those to which some place of the arc
// within `arrangement_radius` is nearer than to any other node, in the order of these places. (The
// arc passes through their cells in the Voronoi diagram of the nodes.) `near` lists the nodes that
// are near to the arc, in any order; those in `required` are taken, too, whether they are the
// nearest ones or not. Returns true if two of the nodes, or a node and an end, are so close to each
// other that their cells may touch near the arc.
bool append_nearest_nodes(std::span<const Point> nodes, NodedArc arc, std::span<const Index> near,
                          std::span<const Index> required, std::vector<Index>& chain);

// Appends nodes that lie exactly on the arc, in their order along it.
void append_nodes_on_arc(std::span<const Point> nodes, NodedArc arc, std::span<const Index> on,
                         std::vector<Index>& chain);

}  // namespace rondel::arrangement
