// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A checksum that tells whether a file still contains what was written to it. It detects failures
// of disks and of killed processes, not forgery.
//
// in    words of 64 bits, in pieces of any size
// out   one word
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace rondel::distributed {

// The checksum of values without padding. It does not depend on how they are divided into pieces;
// only the last piece may end within a word.
class Checksum {
 public:
  template <class T>
  void add(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto bytes = std::as_bytes(values);
    const std::size_t num_words = bytes.size() / word_size;
    std::size_t i = 0;
    for (; i < num_words && num_words_ % num_lanes != 0; ++i) add(word_at(bytes, i));
    // Products of different lanes are independent, so that the processor computes them at once.
    auto lanes = lanes_;
    const std::size_t begin = i;
    for (; i + num_lanes <= num_words; i += num_lanes) {
      for (std::size_t lane = 0; lane < num_lanes; ++lane)
        lanes[lane] = mixed(lanes[lane], word_at(bytes, i + lane));
    }
    lanes_ = lanes;
    num_words_ += i - begin;
    for (; i < num_words; ++i) add(word_at(bytes, i));
    if (bytes.size() == num_words * word_size) return;
    std::uint64_t last = 0;
    std::memcpy(&last, bytes.data() + num_words * word_size, bytes.size() % word_size);
    add(last);
  }

  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t sum = num_words_;
    for (const std::uint64_t lane : lanes_) sum = mixed(sum, lane);
    return sum;
  }

 private:
  static constexpr std::size_t word_size = sizeof(std::uint64_t);
  static constexpr std::size_t num_lanes = 4;

  // The factor is odd, so that different words at one place have different products.
  static constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;

  static std::uint64_t mixed(std::uint64_t sum, std::uint64_t word) {
    const std::uint64_t product = (sum ^ word) * factor;
    return product ^ product >> 32U;
  }

  static std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t i) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i * word_size, word_size);
    return word;
  }

  void add(std::uint64_t word) {
    std::uint64_t& lane = lanes_[num_words_++ % num_lanes];
    lane = mixed(lane, word);
  }

  std::array<std::uint64_t, num_lanes> lanes_ = {1, 2, 3, 4};
  std::uint64_t num_words_ = 0;
};

}  // namespace rondel::distributed
