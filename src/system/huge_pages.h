// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Large arrays in large pages: fewer page faults while they are filled, and fewer misses of the
// translation buffer when they are read out of order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rondel::system {

// Tells the system that this memory, not used yet, is better in huge pages. Only advice: without
// support for it nothing happens. Small ranges are left alone.
void advise_huge_pages(void* memory, std::size_t bytes) noexcept;

// Reserves room in an empty vector.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  advise_huge_pages(values.data(), size * sizeof(T));
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
