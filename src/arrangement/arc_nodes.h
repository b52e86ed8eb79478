// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The nodes after a step of an arrangement: those before it and the places of crossings, and which
// of them an arc has to do with.
//
// in    arcs between nodes, and their contacts
// out   the new nodes, and for each arc the nodes near to it and those of its crossings
// index arcs as in NodedArcs; nodes after the step
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/arc_contacts.h"
#include "arrangement/box_tree.h"
#include "arrangement/noded_arcs.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A node of an arc: near to the arc and none of its ends, or of a crossing of the arc, or both.
struct ArcNode {
  static constexpr std::uint32_t near_to_arc = 1;
  static constexpr std::uint32_t of_crossing = 2;

  Index node;
  std::uint32_t kind;
  friend auto operator<=>(const ArcNode&, const ArcNode&) = default;

  [[nodiscard]] bool is_near() const { return (kind & near_to_arc) != 0; }
  [[nodiscard]] bool is_of_crossing() const { return (kind & of_crossing) != 0; }
};

struct NodesOfArcs {
  std::vector<Point> nodes;
  std::vector<Index> numbers;      // of the nodes before the step
  CompressedRows<ArcNode> of_arc;  // ascending, each node once
};

NodesOfArcs nodes_of_arcs(const NodedArcs& input, const BoxTree& boxes, const Contacts& contacts,
                          unsigned threads);

// Returns for each arc whether it has to go through the nodes near to it. An arc that crosses another
// one is bent, as its crossing is rounded. Where an arc is bent, it is led through all nodes near to
// it, and all arcs near to one of these nodes are bent, too. All other arcs stay as they are.
std::vector<std::uint8_t> bent_arcs(const CompressedRows<ArcNode>& of_arc, std::size_t num_nodes,
                                    unsigned threads);

}  // namespace rondel::arrangement
