// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where two arcs between nodes meet, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "rondel/types.h"

namespace rondel::arrangement {

// The arcs meet in no node, in one, or in two, between which they overlap. Each node is an end of
// one of them, and an end of the other one or in its inside.
struct SideMeeting {
  bool is_crossing = false;  // in the inside of both, where no node is
  std::size_t num_nodes = 0;
  std::array<Index, 2> nodes{};

  void add(Index node) { nodes[num_nodes++] = node; }
};

// Looks at the arcs from a to b and from c to d. `points` has the places of all nodes, which are on
// different rays.
SideMeeting meeting_of(std::span<const Point> points, Index a, Index b, Index c, Index d);

}  // namespace rondel::arrangement
