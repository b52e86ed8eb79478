// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Many growing lists of words in one piece of memory, which is written from front to back and no
// more than needed: the lists are chains of small chunks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/large_vector.h"

namespace rondel::blocks {

class ChunkLists {
 public:
  // Room for `capacity` words in all.
  ChunkLists(std::size_t num_lists, std::size_t capacity)
      : words_(most_words(num_lists, capacity)), ends_(num_lists, 0), num_chunks_(num_lists, 0) {}

  void append(std::size_t list, std::uint64_t word) {
    std::uint64_t& end = ends_[list];
    if (end % chunk == 0) end = new_chunk(list);
    words_[end++] = word;
  }

  [[nodiscard]] std::size_t size(std::size_t list) const {
    const std::uint64_t end = ends_[list];
    return end == 0 ? 0 : (num_chunks_[list] - 1) * (chunk - 1) + (end - 1) % chunk;
  }

  // Copies a list in no particular order. Returns where the copy ends.
  std::uint64_t* copy(std::size_t list, std::uint64_t* target) const {
    for (std::uint64_t end = ends_[list]; end != 0;) {
      const std::uint64_t begin = (end - 1) / chunk * chunk;
      target = std::copy(words_.data() + begin + 1, words_.data() + end, target);
      end = words_[begin];
    }
    return target;
  }

 private:
  static constexpr std::size_t chunk =
      32;  // words, the first of which is where the one before ends

  static std::size_t most_words(std::size_t num_lists, std::size_t capacity) {
    return (capacity / (chunk - 1) + num_lists + 1) * chunk;
  }

  std::uint64_t new_chunk(std::size_t list) {
    words_[used_] = ends_[list];
    used_ += chunk;
    ++num_chunks_[list];
    return used_ - chunk + 1;
  }

  std::size_t used_ = 0;
  LargeVector<std::uint64_t> words_;
  std::vector<std::uint64_t> ends_;  // 0: empty
  std::vector<std::uint32_t> num_chunks_;
};

}  // namespace rondel::blocks
