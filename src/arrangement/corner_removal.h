// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Removes nodes of a network of lines, as far as tolerances and topology allow.
//
// in    a network, a tolerance for each node
// out   what has become of each node
// index nodes of the network
#pragma once

#include <cstdint>
#include <vector>

#include "arrangement/line_network.h"
#include "rondel/types.h"

namespace rondel::arrangement {

enum class NodeState : std::uint8_t {
  kept,       // for ever
  changed,    // its neighbors are others than when it was looked at
  far,        // the arc that would replace it is too far away, or is already there
  candidate,  // it may go if it comes before its neighbors
  blocked,    // another node is in the triangle with its neighbors, or too near
  removed,
  dropped,  // with the last three nodes of a loop
};

// Returns the square of the sine of a tolerance in radians, less than it by all rounding in the
// test of distances; 0 for tolerances that allow nothing.
double squared_sine_below(double tolerance);

struct RemovalRules {
  bool drops_loops = false;  // those that are within the tolerance of one of their sides
  double clearance = 0;      // the share of the tolerance that new arcs keep from other nodes
};

// `limits`: squared_sine_below() of the tolerance of each node. The result does not depend on the
// threads.
std::vector<NodeState> removed_nodes(const LineNetwork& network, std::vector<double> limits,
                                     const RemovalRules& rules, unsigned threads);

}  // namespace rondel::arrangement
