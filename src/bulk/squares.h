// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The squares of the Hilbert curve, and blocks of sites in them.
//
// in    the sites of a build in their order
// out   the blocks that squares cut this order into, and the squares that these are parts of
// index ranks; in a piece, local sites
#pragma once

#include <array>
#include <cstdint>
#include <span>
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

// A square with sites: a block if it is not split, or else the four quarters of it, those that have
// sites.
struct TreeSquare {
  Block block;
  double num_sites = 0;
  unsigned height = 0;  // of a block 0, else 1 more than that of the highest quarter
  std::array<Index, 4> quarters = {no_index, no_index, no_index, no_index};  // among all squares
};

// Splits all ranks into blocks of at most `max_sites`, as far as positions can tell sites apart. Each
// square comes after its quarters, so the blocks are in their order.
std::vector<TreeSquare> make_squares(const Input& input, std::size_t max_sites);
// Splits one square, which has all sites of the input.
std::vector<TreeSquare> make_squares(const Square& square, const Input& input,
                                     std::size_t max_sites);
// Returns the squares that are not split.
std::vector<Block> blocks_of(std::span<const TreeSquare> squares);

// Whether a position on the same face of the cube is in the square.
bool has(const Square& square, const order::CubePosition& p);

// One of its quarters, in the order of the curve.
inline Square quadrant(const Square& square, unsigned rank) {
  Square child = square;
  --child.bits;
  const std::uint64_t half = std::uint64_t{1} << child.bits;
  for (unsigned u = 0; u < 2; ++u) {
    for (unsigned v = 0; v < 2; ++v) {
      if (order::hilbert_table::rank_in(square.state, u, v) != rank) continue;
      child.corner.u += u * half;
      child.corner.v += v * half;
    }
  }
  child.state ^= order::hilbert_table::state_change[rank];
  return child;
}

// The block of at most so many sites to which a rank belongs.
Block block_around(Index rank, const Input& input, std::size_t max_sites);

}  // namespace rondel::bulk
