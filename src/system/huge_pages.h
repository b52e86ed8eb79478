// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Large arrays in large pages: fewer page faults while they are filled, and fewer misses of the
// translation buffer when they are read out of order.
#pragma once

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

}  // namespace rondel::system
