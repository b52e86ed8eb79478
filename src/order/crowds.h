// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Crowds: many sites with one key, closer than positions on a face of the cube can tell. Their
// ranks follow their coordinates, which says nothing of directions: neighbors in rank are far apart
// among them. So they are inserted in another order. Sites can be so close only around the middle of
// a face, (u, v) = (0, 0); they come by their distance from it, to powers of two, and at one
// distance along a curve. What is inserted first changes no result.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::order {

// The ranks, those of a crowd in its own order. Empty if there is no crowd. `order` lists the sites
// of each rank.
std::vector<Index> ranks_with_crowds_in_order(std::span<const Point> sites,
                                              std::span<const Index> order, Model model,
                                              const Point& center);

}  // namespace rondel::order
