// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces come in spatial order, but sites in the order of the input: what a face refers to is
// anywhere in memory. Loops over faces know what they will need and ask for it early.
#pragma once

#include <cstddef>

namespace rondel::dual {

// How many faces ahead: the work on so many covers one miss of all caches.
constexpr std::size_t prefetch_distance = 24;

template <class T>
void prefetch(const T* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

}  // namespace rondel::dual
