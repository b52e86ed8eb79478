// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where a tessellation starts: few sites, and more of them level by level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

// The numbers of sites of the levels, the coarsest first; a level has at least 4 n - 6 of n before, what the
// middles of edges give, and at most 3 more.
std::vector<std::size_t> counts_of_levels(std::size_t count, std::size_t fewest);

// The 12 corners of an icosahedron, two of them poles.
std::vector<Point> icosahedron();

// Sites with the number density 1 / spacing^2, one random place for each of as many equal parts.
std::vector<Point> sampled_sites(std::size_t count, const SizeFunction* size, std::uint64_t seed);

// The sites, one in the middle of every edge, and as many more as are wanted, in the largest faces; in spatial
// order.
std::vector<Point> refined_sites(const std::vector<Point>& sites, std::size_t count,
                                 const SizeFunction* size, unsigned threads);

// In the order in which the faces come to them.
std::vector<Point> in_spatial_order(std::vector<Point> sites, unsigned threads);

}  // namespace rondel::mesh
