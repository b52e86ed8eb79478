// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Random numbers that are the same on every machine: Sebastiano Vigna's splitmix64 (public domain).
//
// in    a seed; every seed is good
// out   multiples of 2^-53 in [0, 1)
#pragma once

#include <cstdint>

namespace rondel::mesh {

class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : state_(seed) {}

  // Returns a number from 0 to less than 1.
  double operator()() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace rondel::mesh
