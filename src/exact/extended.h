// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers with 64 bits: about as fast as doubles where the processor has them.
#pragma once

#include <limits>

namespace rondel::exact {

// 2^-64.
inline constexpr long double extended_unit_roundoff = 0x1p-64L;

// Whether long double rounds to 64 bits. Not so where it is another type, where the processor is
// set to fewer bits, and in some emulators.
inline bool has_extended_precision() {
  static const bool result = [] {
    if constexpr (std::numeric_limits<long double>::digits != 64) return false;
    const volatile long double one = 1;
    const volatile long double unit = 2 * extended_unit_roundoff;
    return one + unit != one;
  }();
  return result;
}

}  // namespace rondel::exact
