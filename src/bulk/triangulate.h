// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The bulk build: from sites in spatial order to the arrays of the result. Few sites that surround
// the center are triangulated at once (sphere.h), many by certified blocks:
//
// 1. Blocks: the sites of a square of the Hilbert curve, triangulated by divide and conquer.
// 2. Certificate: the faces of a block that no site outside can be in conflict with are final.
// 3. Seam: the sites of all other faces, some sqrt(n) of n, are triangulated in the same way.
// 4. Stitch: the final faces and those of the seam in the region between them are the result.
//
// Since the triangulation is unique, neither the blocks nor the threads can change the result.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernel/triangulate.h"
#include "system/large_vector.h"

namespace rondel::bulk {

// From so many sites on it pays to copy them in their order: to read them one by one from
// everywhere in memory takes longer.
inline constexpr std::size_t least_copied_sites = std::size_t{3} << 18;

// As kernel::triangulate. `copies` is empty, or system::SiteCopies of the sites by rank lie in
// its memory, which becomes that of the faces.
kernel::Triangulated triangulate(std::span<const Point> sites, std::vector<Index> order,
                                 std::span<const order::Renamed> renamed,
                                 const system::Job& options, LargeVector<Triple> copies = {});

// The same with blocks of at most so many sites, or nothing if the sites do not suit this: when the
// seam has no hull, because all its sites lie on one great circle.
std::optional<kernel::Triangulated> triangulate_by_blocks(std::span<const Point> sites,
                                                          std::span<const Index> order,
                                                          std::span<const order::Renamed> renamed,
                                                          const system::Job& options,
                                                          std::size_t max_block_sites,
                                                          LargeVector<Triple> copies = {});

}  // namespace rondel::bulk
