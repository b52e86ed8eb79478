// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// An array for code of wide vectors (wide_vectors.h), which may call nothing that is not always inline:
// std::array's operators are not.
#pragma once

#include <cstddef>

#include "system/wide_vectors.h"

namespace rondel::system {

template <class T, std::size_t N>
struct PlainArray {
  T items[N];

  RONDEL_ALWAYS_INLINE constexpr T& operator[](std::size_t i) { return items[i]; }
  RONDEL_ALWAYS_INLINE constexpr const T& operator[](std::size_t i) const { return items[i]; }
};

}  // namespace rondel::system
