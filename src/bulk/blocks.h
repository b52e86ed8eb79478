// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The build by certified blocks, in parallel:
//
// 1. Blocks: the sites of a square of the Hilbert curve, triangulated by divide and conquer.
// 2. Certificate: the faces of a block that no site outside can be in conflict with are final.
// 3. Seam: the sites of all other faces, some 4 % of all, are triangulated by themselves, in larger
//    squares if there are many, and at last over the whole sphere.
// 4. Stitch: the final faces and those of the seam in the region between them are the result.
//
// in    the sites in spatial order
// out   the arrays of the result
// index ranks; each block has local sites, and the seam has seam sites of its own
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bulk/input.h"
#include "bulk/seam_tree.h"
#include "kernel/triangulate.h"
#include "system/large_arrays.h"

namespace rondel::bulk {

// The mesh of a block lies in the second cache, and its seam is a small part of it.
inline constexpr std::size_t default_max_block_sites = 3 << 14;

// Whether blocks would leave little to the seam, judged by some small ones. They do not where sites
// lie on curves, or are hidden: then all is seam, and blocks are a detour.
bool has_short_seams(const Input& input);

// Steps 1 and 2 alone. Room for the faces of the blocks is made in `arrays`.
std::vector<BlockResult> triangulate_blocks(const Input& input, const std::vector<Block>& blocks,
                                            TriangulationArrays& arrays);

// Computes what kernel::triangulate does, with blocks of at most `max_block_sites`, or with smaller ones
// where threads would wait; returns nothing if the seam has no hull, because all its sites lie on one
// great circle. The faces are written into the memory of `copies`, which may be that of the copies in
// `input`: blocks read their sites before they write their faces. `rule` says when the seam is long.
std::optional<kernel::Triangulated> triangulate_by_blocks(const Input& input,
                                                          std::span<const order::Renamed> renamed,
                                                          std::size_t max_block_sites,
                                                          LargeVector<Triple> copies = {},
                                                          const SeamRule& rule = {});

}  // namespace rondel::bulk
