// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/squares.h"

#include <algorithm>
#include <array>

#include "system/parallel.h"

namespace rondel::bulk {
namespace {

// The first rank in begin ... end-1 for which this is so; it is so for all that follow.
template <class Predicate>
Index find_first(Index begin, Index end, Predicate predicate) {
  while (begin < end) {
    const Index middle = begin + (end - begin) / 2;
    if (predicate(middle)) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin;
}

bool is_small(const Block& block, std::size_t max_sites) {
  return block.end - block.begin <= max_sites || block.square.bits == 0;
}

std::array<Block, 4> quarters(const Block& block, const Input& input) {
  std::array<Block, 4> result{};
  Index begin = block.begin;
  for (unsigned rank = 0; rank < 4; ++rank) {
    const Square square = quadrant(block.square, rank);
    const Index end = rank == 3 ? block.end : find_first(begin, block.end, [&](Index i) {
      return !has(square, input.position(i));
    });
    result[rank] = {begin, end, square};
    begin = end;
  }
  return result;
}

// Returns the number of the square, or no_index if it has no sites.
Index split(const Block& block, std::size_t max_sites, const Input& input,
            std::vector<TreeSquare>& squares);

// The numbers of these blocks, which have so many sites in all. Sites are looked up all over the memory:
// where there are many, threads do so at the same time, for squares that are numbered afterwards.
template <std::size_t N>
std::array<Index, N> split_all(const std::array<Block, N>& blocks, std::size_t num_sites,
                               std::size_t max_sites, const Input& input,
                               std::vector<TreeSquare>& squares) {
  constexpr std::size_t many_sites = std::size_t{1} << 16;
  std::array<Index, N> numbers{};
  if (num_sites < many_sites) {
    for (std::size_t i = 0; i < N; ++i) numbers[i] = split(blocks[i], max_sites, input, squares);
    return numbers;
  }
  std::array<std::vector<TreeSquare>, N> parts;
  system::parallel_for(input.options.threads, N, 1, [&](std::size_t i, std::size_t /*end*/) {
    numbers[i] = split(blocks[i], max_sites, input, parts[i]);
  });
  for (std::size_t i = 0; i < N; ++i) {
    const auto first = static_cast<Index>(squares.size());
    if (numbers[i] != no_index) numbers[i] += first;
    for (TreeSquare& square : parts[i]) {
      for (Index& quarter : square.quarters) {
        if (quarter != no_index) quarter += first;
      }
      squares.push_back(square);
    }
  }
  return numbers;
}

Index split(const Block& block, std::size_t max_sites, const Input& input,
            std::vector<TreeSquare>& squares) {
  if (block.begin == block.end) return no_index;
  TreeSquare square = {block, static_cast<double>(block.end - block.begin)};
  if (!is_small(block, max_sites)) {
    square.quarters =
        split_all(quarters(block, input), block.end - block.begin, max_sites, input, squares);
    for (const Index quarter : square.quarters) {
      if (quarter == no_index) continue;
      square.height = std::max(square.height, squares[quarter].height + 1);
    }
  }
  squares.push_back(square);
  return static_cast<Index>(squares.size() - 1);
}

}  // namespace

bool has(const Square& square, const order::CubePosition& p) {
  return (p.u - square.corner.u) >> square.bits == 0 && (p.v - square.corner.v) >> square.bits == 0;
}

std::array<Block, 6> cube_faces(const Input& input) {
  const auto num_ranks = static_cast<Index>(input.order.size());
  std::array<Block, 6> result{};
  Index begin = 0;
  for (unsigned face = 0; face < 6; ++face) {
    const Index end =
        find_first(begin, num_ranks, [&](Index i) { return input.position(i).face > face; });
    result[face] = {begin, end, {{face, 0, 0}, order::position_bits, 0}};
    begin = end;
  }
  return result;
}

std::vector<TreeSquare> make_squares(const Input& input, std::size_t max_sites) {
  std::vector<TreeSquare> squares;
  split_all(cube_faces(input), input.order.size(), max_sites, input, squares);
  return squares;
}

std::vector<TreeSquare> make_squares(const Square& square, const Input& input,
                                     std::size_t max_sites) {
  std::vector<TreeSquare> squares;
  split({0, static_cast<Index>(input.order.size()), square}, max_sites, input, squares);
  return squares;
}

std::vector<Block> blocks_of(std::span<const TreeSquare> squares) {
  std::vector<Block> blocks;
  for (const TreeSquare& square : squares) {
    if (square.height == 0) blocks.push_back(square.block);
  }
  return blocks;
}

Block block_around(Index rank, const Input& input, std::size_t max_sites) {
  const auto has_rank = [rank](const Block& b) { return b.begin <= rank && rank < b.end; };
  const auto faces = cube_faces(input);
  Block block = *std::ranges::find_if(faces, has_rank);
  while (!is_small(block, max_sites)) {
    const auto parts = quarters(block, input);
    block = *std::ranges::find_if(parts, has_rank);
  }
  return block;
}

}  // namespace rondel::bulk
