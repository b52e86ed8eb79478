// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Choices as arithmetic, of which GCC makes vector code where it does not of branches.
#pragma once

#include <bit>
#include <cstdint>

#include "system/wide_vectors.h"

namespace rondel::system {

// All bits, or none.
RONDEL_ALWAYS_INLINE inline std::uint64_t mask(bool condition) {
  return std::uint64_t{0} - static_cast<std::uint64_t>(condition);
}

RONDEL_ALWAYS_INLINE inline double choose(std::uint64_t mask, double yes, double no) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(yes) & mask) |
                               (std::bit_cast<std::uint64_t>(no) & ~mask));
}

}  // namespace rondel::system
