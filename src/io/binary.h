// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers as the bytes of files, which are the same on every machine: the lowest byte first, unless
// another order is given.
//
// in    arrays of numbers, or of structures of numbers
// out   their bytes; or numbers from bytes
//
// Rows of an array are stored one after the other, without padding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/atomic_file.h"
#include "rondel/triangulation.h"

namespace rondel::io {

// Returns unsigned bits with their bytes reversed. The masks and shifts are a pattern that
// compilers recognize as one instruction, and vectorize.
template <typename Bits>
constexpr Bits reversed(Bits bits) {
  static_assert(std::is_unsigned_v<Bits>);
  if constexpr (sizeof(Bits) == 8) {
    bits = (bits >> 32U) | (bits << 32U);
    bits = (bits >> 16U & 0x0000'ffff'0000'ffff) | (bits & 0x0000'ffff'0000'ffff) << 16U;
    return (bits >> 8U & 0x00ff'00ff'00ff'00ff) | (bits & 0x00ff'00ff'00ff'00ff) << 8U;
  } else if constexpr (sizeof(Bits) == 4) {
    bits = (bits >> 16U) | (bits << 16U);
    return (bits >> 8U & 0x00ff'00ffU) | (bits & 0x00ff'00ffU) << 8U;
  } else {
    static_assert(sizeof(Bits) == 1);
    return bits;
  }
}

// Copies `count` numbers of `size` bytes, each with its bytes reversed. Neither address need be
// aligned.
template <std::size_t size>
void copy_reversed(const char* numbers, std::size_t count, char* bytes) {
  using Bits = std::conditional_t<size == 8, std::uint64_t,
                                  std::conditional_t<size == 4, std::uint32_t, std::uint8_t>>;
  static_assert(sizeof(Bits) == size);
  for (std::size_t i = 0; i < count; ++i) {
    Bits bits;
    std::memcpy(&bits, numbers + i * size, size);
    bits = reversed(bits);
    std::memcpy(bytes + i * size, &bits, size);
  }
}

// Stores the numbers one after the other at `bytes`, which need not be aligned.
template <typename T>
void store_all(std::span<const T> numbers, char* bytes, std::endian order) {
  if (order == std::endian::native) {
    std::memcpy(bytes, numbers.data(), numbers.size_bytes());
  } else {
    copy_reversed<sizeof(T)>(reinterpret_cast<const char*>(numbers.data()), numbers.size(), bytes);
  }
}

// Returns the number stored at `bytes`, which need not be aligned.
template <typename T>
T load(const char* bytes, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

// Stores the number at `bytes`, which need not be aligned; returns where it ends.
template <typename T>
char* store(T number, char* bytes, std::endian order = std::endian::little) {
  auto copy = std::bit_cast<std::array<char, sizeof(T)>>(number);
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::copy(copy.begin(), copy.end(), bytes);
}

// The type of the numbers that an element of an array consists of.
template <typename Element>
struct NumbersOf {
  static_assert(std::is_arithmetic_v<Element>);
  using Number = Element;
};
template <typename T, std::size_t size>
struct NumbersOf<std::array<T, size>> {
  using Number = T;
};
template <>
struct NumbersOf<Point> {
  using Number = double;
};
template <>
struct NumbersOf<LonLat> {
  using Number = double;
};
template <>
struct NumbersOf<Triple> {
  using Number = Index;
};
template <>
struct NumbersOf<Duplicate> {
  using Number = Index;
};
template <>
struct NumbersOf<Hidden> {
  using Number = Index;
};
static_assert(sizeof(Point) == 3 * sizeof(double));
static_assert(sizeof(LonLat) == 2 * sizeof(double));
static_assert(sizeof(Triple) == 3 * sizeof(Index));
static_assert(sizeof(Duplicate) == 2 * sizeof(Index) && sizeof(Hidden) == 2 * sizeof(Index));

// The bytes of an array of numbers, or of structures of numbers without padding. They are the
// array's own if the machine has the wanted byte order, and otherwise those of a copy that lives as
// long as this object.
class NumberBytes {
 public:
  template <typename Values>
  explicit NumberBytes(const Values& values, std::endian order = std::endian::little)
      : bytes_(reinterpret_cast<const char*>(std::data(values)),
               std::size(values) * sizeof(*std::data(values))) {
    using Element = std::remove_cvref_t<decltype(*std::data(values))>;
    if (order != std::endian::native) reverse<sizeof(typename NumbersOf<Element>::Number)>();
  }
  NumberBytes(const NumberBytes&) = delete;
  NumberBytes& operator=(const NumberBytes&) = delete;

  // NOLINTNEXTLINE(google-explicit-constructor): it is what it says
  operator std::string_view() const { return bytes_; }

 private:
  template <std::size_t size>
  void reverse() {
    copy_.resize(bytes_.size());
    copy_reversed<size>(bytes_.data(), bytes_.size() / size, copy_.data());
    bytes_ = copy_;
  }

  std::string copy_;
  std::string_view bytes_;
};

// Writes value(0), ..., value(count - 1) as numbers of type T.
template <typename T, typename Value>
void write_values(AtomicFile& file, std::size_t count, Value value) {
  std::array<T, 4096> block;
  for (std::size_t start = 0; start < count; start += block.size()) {
    const std::size_t size = std::min(block.size(), count - start);
    for (std::size_t i = 0; i < size; ++i) block[i] = static_cast<T>(value(start + i));
    file.write(NumberBytes(std::span(block.data(), size)));
  }
}

}  // namespace rondel::io
