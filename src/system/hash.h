// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of numbers and of points.
#pragma once

#include <bit>
#include <cstdint>

#include "rondel/types.h"

namespace rondel::system {

// 2^64 over the golden ratio, an odd number: products with it have good upper bits.
inline constexpr std::uint64_t golden_multiplier = 0x9e3779b97f4a7c15U;

// Returns the hash of what `hash` is of and one more number.
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t number) {
  hash = (hash ^ number) * golden_multiplier;
  return hash ^ (hash >> 32U);
}

// Returns the bits of a double, the same for 0 and -0: adding 0 turns -0 into 0.
inline std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

// Returns a hash that equal points share.
inline std::uint64_t hash_of(const Point& p, std::uint64_t seed = 0) {
  return mixed(mixed(mixed(seed, bits_of(p.x)), bits_of(p.y)), bits_of(p.z));
}

inline std::uint64_t hash_of(const LonLat& position) {
  return mixed(mixed(mixed(0, bits_of(position.lon_deg)), bits_of(position.lat_deg)), 0);
}

}  // namespace rondel::system
