// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Packs arrays of plain values into words of 64 bits, for journals and for other processes.
//
// in    words, and vectors of plain values
// out   one sequence of words
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace rondel::distributed {

using Words = std::vector<std::uint64_t>;

constexpr std::size_t words_of_bytes(std::size_t num_bytes) { return (num_bytes + 7) / 8; }

// Builds a sequence of words.
class WordWriter {
 public:
  void add(std::uint64_t word) { words_.push_back(word); }

  // Appends the size of the vector and its values.
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(values.size());
    const std::size_t begin = words_.size();
    words_.resize(begin + words_of_bytes(values.size() * sizeof(T)));
    if (!values.empty()) std::memcpy(&words_[begin], values.data(), values.size() * sizeof(T));
  }

  [[nodiscard]] const Words& words() const { return words_; }

 private:
  Words words_;
};

// Reads what a WordWriter wrote. Precondition: the words are unchanged, as a checksum tells.
class WordReader {
 public:
  explicit WordReader(std::span<const std::uint64_t> words) : words_(words) {}

  std::uint64_t word() { return words_[next_++]; }

  template <class T>
  void read(std::vector<T>& values) {
    values.resize(word());
    if (values.empty()) return;
    std::memcpy(static_cast<void*>(values.data()), &words_[next_], values.size() * sizeof(T));
    next_ += words_of_bytes(values.size() * sizeof(T));
  }

 private:
  std::span<const std::uint64_t> words_;
  std::size_t next_ = 0;
};

}  // namespace rondel::distributed
