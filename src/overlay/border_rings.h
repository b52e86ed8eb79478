// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions from what is around them: arcs in any order become rings.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// From one point to another along a great circle, with a region to the left.
struct KeyedArc {
  Index key;  // of the region
  Point from;
  Point to;
};

// Cell i has the rings around the region with the key i.
// 1. Arcs of one region that run to and fro between two points vanish, so that what touches there is joined.
// 2. Where rings of a region meet in a point each keeps to one part of it.
// 3. Rings begin at their corner with the least coordinates and are sorted by them; points are sorted by
//    coordinates. So nothing depends on the order of the arcs.
// 4. Rings that are no larger than what rounding of their corners may make are left out.
CellRings rings_around(std::span<const KeyedArc> arcs, std::size_t num_keys, unsigned threads);

// Whether there are as many arcs from any point to any other one as back, so that they bound nothing.
bool is_nothing(std::span<const KeyedArc> arcs);

}  // namespace rondel::overlay
