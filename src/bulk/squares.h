// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The squares of the Hilbert curve, and blocks of sites in them.
//
// in    the sites of a build in their order
// out   the blocks that squares cut this order into
// index ranks; in a piece, local sites
#pragma once

#include <array>
#include <vector>

#include "bulk/input.h"
#include "order/hilbert.h"

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
std::array<Block, 6> cube_faces(const Input& input);

// Splits all ranks into blocks of at most `max_sites`, in their order, as far as positions can tell
// sites apart.
std::vector<Block> make_blocks(const Input& input, std::size_t max_sites);

// The block of at most so many sites to which a rank belongs.
Block block_around(Index rank, const Input& input, std::size_t max_sites);

}  // namespace rondel::bulk
