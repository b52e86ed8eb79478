// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces come in spatial order, but sites in the order of the input: what a face refers to is
// anywhere in memory. Loops over faces know what they will need and ask for it early.
#pragma once

#include <cstddef>

namespace rondel::system {

// How many faces (sites, queries) ahead: the work on so many covers one miss of all caches.
constexpr std::size_t prefetch_distance = 24;

// Asks for the first and the last byte: an object may straddle two cache lines.
template <class T>
void prefetch(const T* object) {
#if defined(__GNUC__)
  const auto* bytes = reinterpret_cast<const char*>(object);
  __builtin_prefetch(bytes);
  if constexpr (sizeof(T) > sizeof(void*)) __builtin_prefetch(bytes + sizeof(T) - 1);
#else
  static_cast<void>(object);
#endif
}

// Asks for the first byte, which will be written.
template <class T>
void prefetch_to_write(T* object) {
#if defined(__GNUC__)
  __builtin_prefetch(object, 1);
#else
  static_cast<void>(object);
#endif
}

}  // namespace rondel::system
