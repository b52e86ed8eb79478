// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A hash of arrays of integers and doubles that does not depend on the order of a machine's bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace rondel::test {

// The number of a result that is stored there: an integer, or the bits of a double.
template <class Number>
Number number_at(const char* bytes) {
  Number number = 0;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

// FNV-1a (Fowler, Noll, Vo), on words of four bytes; of a number of eight bytes the lower word first.
class Hash {
 public:
  template <class T>
  void add(std::span<const T> values) {
    add_word(values.size());
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    if constexpr (alignof(T) == alignof(std::uint32_t)) {
      for (std::size_t i = 0; i < values.size_bytes(); i += sizeof(std::uint32_t)) {
        add_word(number_at<std::uint32_t>(bytes + i));
      }
    } else {
      static_assert(alignof(T) == alignof(std::uint64_t));
      for (std::size_t i = 0; i < values.size_bytes(); i += sizeof(std::uint64_t)) {
        const auto number = number_at<std::uint64_t>(bytes + i);
        add_word(number & 0xffff'ffffU);
        add_word(number >> 32U);
      }
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x0000'0100'0000'01b3U; }

  [[nodiscard]] std::string text() const {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx",
                  static_cast<unsigned long long>(value_));  // NOLINT(google-runtime-int)
    return digits.data();
  }

 private:
  std::uint64_t value_ = 0xcbf2'9ce4'8422'2325U;
};

}  // namespace rondel::test
