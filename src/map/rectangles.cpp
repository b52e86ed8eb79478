// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/rectangles.h"

#include <bit>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace rondel::map {
namespace {

// Moves bit k to place 2k.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16U) & 0x0000FFFF0000FFFFU;
  bits = (bits | bits << 8U) & 0x00FF00FF00FF00FFU;
  bits = (bits | bits << 4U) & 0x0F0F0F0F0F0F0F0FU;
  bits = (bits | bits << 2U) & 0x3333333333333333U;
  return (bits | bits << 1U) & 0x5555555555555555U;
}

// Returns the bits of two numbers below 2^32 in turns, of which those of the first one come first.
std::uint64_t in_turns(std::uint64_t first, std::uint64_t second) {
  return spread(first) << 1U | spread(second);
}

bool is_in_few_runs(const std::vector<Line>& lines) {
  constexpr std::size_t few = 64;
  std::size_t num_runs = 1;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    num_runs += lines[i - 1].to == lines[i].from ? 0 : 1;
  }
  return num_runs < few;
}

}  // namespace

std::vector<std::size_t> order_along_curve(const std::vector<Line>& lines) {
  if (is_in_few_runs(lines)) return {};
  Rectangle all = Rectangle::around(lines[0]);
  for (const Line& line : lines) {
    const Rectangle around = Rectangle::around(line);
    all = {std::min(all.west, around.west), std::max(all.east, around.east),
           std::min(all.south, around.south), std::max(all.north, around.north)};
  }
  const double size = std::max(all.east - all.west, all.north - all.south);
  constexpr double largest_key = 0xFFFFFF00;  // rounding does not make it 2^32
  const double scale = size > 0 ? largest_key / size : 0;
  std::vector<std::uint64_t> keys;
  keys.reserve(lines.size());
  for (const Line& line : lines) {
    const Rectangle around = Rectangle::around(line);
    keys.push_back(in_turns(static_cast<std::uint32_t>((around.west - all.west) * scale),
                            static_cast<std::uint32_t>((around.south - all.south) * scale)));
  }
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::tuple(keys[i], i); });
  return order;
}

// The halves of which a pair has one line each are at level bit_width(i ^ j) - 1, and make up a node
// of the next level. Nodes come before those that contain them, so they are sorted by their ends and
// their levels. Below its node, a pair is at i's bit and then at j's bit, from the highest level to
// the lowest.
void sort_as_in_tree(std::vector<LinePair>& pairs) {
  std::ranges::sort(pairs, {}, [](const LinePair& pair) {
    const auto level = static_cast<unsigned>(std::bit_width(pair.first ^ pair.second));
    return std::tuple(((pair.first >> level) + 1) << level, level,
                      in_turns(pair.first, pair.second));
  });
}

}  // namespace rondel::map
