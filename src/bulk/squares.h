// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The squares of the Hilbert curve, and blocks of sites in them.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "order/hilbert.h"
#include "rondel/types.h"

namespace rondel::bulk {

// A square of 2^bits positions either way on a face of the cube.
struct Square {
  order::CubePosition corner;  // the lowest position
  int bits = 0;
  unsigned state = 0;  // of the curve in this square, see order/hilbert.h
};

// The ranks begin ... end-1 are all sites of the square.
struct Block {
  Index begin = 0;
  Index end = 0;
  Square square;
};

// The sites on each face of the cube, empty blocks included.
std::array<Block, 6> cube_faces(Index num_ranks,
                                const std::function<order::CubePosition(Index)>& position);

// Splits the ranks 0 ... num_ranks-1 into blocks of at most `max_sites`, in their order, as far as
// positions can tell sites apart. `position` gives the position of a rank.
std::vector<Block> make_blocks(Index num_ranks, std::size_t max_sites,
                               const std::function<order::CubePosition(Index)>& position);

// The block of at most so many sites to which a rank belongs.
Block block_around(Index rank, Index num_ranks, std::size_t max_sites,
                   const std::function<order::CubePosition(Index)>& position);

}  // namespace rondel::bulk
