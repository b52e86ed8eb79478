// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors for large results.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "rondel/export.h"

namespace rondel {

namespace detail {

// Uninitialized memory. It begins with a cache line, from 2 MB on with a huge page, where the
// system has these. Throws std::bad_alloc.
RONDEL_API void* allocate_large(std::size_t bytes);
// What allocate_large() returned.
RONDEL_API void free_large(void* memory) noexcept;

}  // namespace detail

// The allocator of LargeVector.
template <class T>
class LargeAllocator {
 public:
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): as every allocator
  LargeAllocator(const LargeAllocator<U>& /*other*/) noexcept {}

  [[nodiscard]] T* allocate(std::size_t size) {
    if (size > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(detail::allocate_large(size * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t /*size*/) noexcept { detail::free_large(memory); }

  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

// A vector whose elements have no value yet when resize(n) or a constructor
// makes them without one: to write zeros first takes time, in one thread.
// It is aligned to cache lines of 64 bytes, from 2 MB on to huge pages.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace rondel
