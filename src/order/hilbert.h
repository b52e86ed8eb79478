// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A Hilbert curve on each face of the cube around the sphere (D. Hilbert, Math. Ann. 38, 1891).
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace rondel::order {

// Where a direction leaves the cube: the face, and the position on it as integers of
// `position_bits` bits.
struct CubePosition {
  unsigned face = 0;
  std::uint64_t u = 0;
  std::uint64_t v = 0;
};

inline constexpr int position_bits = 52;
inline constexpr int high_levels = 28;  // 3 + 2*28 bits in the high key
inline constexpr int low_levels = position_bits - high_levels;

namespace hilbert_table {

// In the basic square the curve visits the quadrants (u, v) = 00, 01, 11, 10. A state tells how
// a square differs from it: bit 0 exchanges u and v, bit 1 turns both around. The first quadrant
// is entered exchanged, the last one exchanged and turned around.
inline constexpr std::array<unsigned, 4> rank_of_quadrant = {0, 1, 3, 2};  // index 2u + v
inline constexpr std::array<unsigned, 4> state_change = {1, 0, 0, 3};      // index rank

constexpr unsigned rank_in(unsigned state, unsigned u, unsigned v) {
  const bool is_exchanged = (state & 1) != 0;
  const unsigned quadrant = is_exchanged ? 2 * v + u : 2 * u + v;
  return rank_of_quadrant[(state & 2) != 0 ? 3 - quadrant : quadrant];
}

struct CurveStep {
  std::uint8_t key;
  std::uint8_t state;
};

// Four levels at once: indexed by state, four bits of u, four bits of v.
consteval std::array<CurveStep, 1024> make_steps() {
  std::array<CurveStep, 1024> steps{};
  for (unsigned i = 0; i < 1024; ++i) {
    unsigned state = i >> 8;
    unsigned key = 0;
    for (int level = 3; level >= 0; --level) {
      const unsigned rank = rank_in(state, (i >> (4 + level)) & 1, (i >> level) & 1);
      key = 4 * key + rank;
      state ^= state_change[rank];
    }
    steps[i] = {static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(state)};
  }
  return steps;
}

inline constexpr std::array<CurveStep, 1024> steps = make_steps();

}  // namespace hilbert_table

struct HilbertKey {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  friend auto operator<=>(const HilbertKey&, const HilbertKey&) = default;
};

// The position along the curve: all levels of one position are (high, low). What is not used of it
// is not computed.
inline HilbertKey hilbert_key(const CubePosition& p) {
  std::uint64_t key = p.face;
  unsigned state = 0;
  const auto advance = [&](int bit) {
    const unsigned u = static_cast<unsigned>(p.u >> bit) & 15U;
    const unsigned v = static_cast<unsigned>(p.v >> bit) & 15U;
    const hilbert_table::CurveStep step = hilbert_table::steps[(state << 8) | (u << 4) | v];
    state = step.state;
    key = key << 8 | step.key;
  };
  int bit = position_bits - 4;
  for (; bit >= low_levels; bit -= 4) advance(bit);
  const std::uint64_t high = key;
  for (key = 0; bit >= 0; bit -= 4) advance(bit);
  return {high, key};
}

}  // namespace rondel::order
