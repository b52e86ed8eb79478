// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers as bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <string_view>

#include "io/atomic_file.h"
#include "rondel/triangulation.h"

namespace rondel::io {

// The writers copy memory and declare it little-endian.
static_assert(std::endian::native == std::endian::little);

// The number stored at `bytes`, which need not be aligned.
template <typename T>
T load(const char* bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

// The bytes of an array of numbers, or of structures of numbers without gaps.
template <typename Values>
std::string_view bytes_of(const Values& values) {
  return {reinterpret_cast<const char*>(std::data(values)),
          std::size(values) * sizeof(*std::data(values))};
}
static_assert(sizeof(Point) == 3 * sizeof(double));
static_assert(sizeof(LonLat) == 2 * sizeof(double));
static_assert(sizeof(Triple) == 3 * sizeof(Index));
static_assert(sizeof(Hidden) == 2 * sizeof(Index));

// Writes value(0), ..., value(count - 1) as numbers of type T.
template <typename T, typename Value>
void write_values(AtomicFile& file, std::size_t count, Value value) {
  std::array<T, 4096> block;
  for (std::size_t start = 0; start < count; start += block.size()) {
    const std::size_t size = std::min(block.size(), count - start);
    for (std::size_t i = 0; i < size; ++i) block[i] = static_cast<T>(value(start + i));
    file.write({reinterpret_cast<const char*>(block.data()), size * sizeof(T)});
  }
}

}  // namespace rondel::io
