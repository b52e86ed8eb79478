// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The opposite of each halfedge of some rings.
//
// in    rings of corners, by their offsets
// out   twins: halfedges that run the other way between the same points
// index halfedges are corners, and lead from there to the next one of the ring
#pragma once

#include <cstddef>
#include <span>

#include "rondel/types.h"
#include "system/large_arrays.h"

namespace rondel::overlay {

// twins[h] is the halfedge opposite to h, or no_index where there is none. Where several lead from one
// point to another, the first one in one direction is opposite to the first one in the other, and so
// on. The corners are less than num_points.
LargeVector<Index> twins_of(std::span<const Index> rings, std::span<const Index> corners,
                            std::size_t num_points, unsigned threads);

}  // namespace rondel::overlay
