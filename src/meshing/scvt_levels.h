// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sites with which a tessellation starts: few of them, and more level by level.
//
// in    the wanted number of sites, a size function or none, a seed
// out   unit vectors
// index sites, in spatial order where they are refined; seeds choose random starts
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

// Returns the numbers of sites of the levels, the coarsest first. A level that follows one of n
// sites has between 4 n - 6 sites (one more in the middle of each edge) and 3 more than that.
std::vector<std::size_t> counts_of_levels(std::size_t count, std::size_t fewest);

// Returns the 12 corners of an icosahedron, two of them poles.
std::vector<Point> icosahedron();

// Returns sites with the number density 1 / spacing^2: a random place in each of `count` equal
// shares.
std::vector<Point> sampled_sites(std::size_t count, const SizeFunction* size, std::uint64_t seed);

// Returns the sites, one in the middle of every edge, and more in the largest faces until there are
// `count`, all in spatial order.
std::vector<Point> refined_sites(const std::vector<Point>& sites, std::size_t count,
                                 const SizeFunction* size, unsigned threads);

// Returns the sites in the order in which the faces of their triangulation have them.
std::vector<Point> in_spatial_order(std::vector<Point> sites, unsigned threads);

}  // namespace rondel::mesh
