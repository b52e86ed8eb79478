// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Vectors and arrays for large results.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
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

namespace rondel::system {

// Large arrays in large pages: fewer page faults while they are filled, and fewer misses of the
// translation buffer when they are read out of order.

// Tells the system that this memory, not used yet, is better in huge pages. Only advice: without
// support for it nothing happens. Small ranges are left alone.
RONDEL_API void advise_huge_pages(void* memory, std::size_t bytes) noexcept;

// Memory for a large array that does not grow, where a LargeVector would have values to set.
struct FreeLarge {
  void operator()(void* memory) const noexcept { detail::free_large(memory); }
};
template <class T>
using LargeArray = std::unique_ptr<T[], FreeLarge>;

template <class T>
LargeArray<T> make_large_array(std::size_t size) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  if (size > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
  return LargeArray<T>(static_cast<T*>(detail::allocate_large(size * sizeof(T))));
}

// Reserves room in an empty vector.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  advise_huge_pages(values.data(), size * sizeof(T));
}

// A vector of so many zeros.
template <class T>
std::vector<T> large_vector(std::size_t size) {
  std::vector<T> result;
  reserve_large(result, size);
  result.resize(size);
  return result;
}

// Room for one more value where there is none, as push_back makes it.
template <class T>
void grow_large(std::vector<T>& values) {
  if (values.size() < values.capacity()) return;
  std::vector<T> longer;
  reserve_large(longer, std::max<std::size_t>(2 * values.size(), 1));
  longer.assign(values.begin(), values.end());
  values.swap(longer);
}

}  // namespace rondel::system
