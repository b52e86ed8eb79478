// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A radix tree that cuts the keys into intervals with few sites each, for any distribution: grown
// from a sample of the keys. Spread-out sites find their interval by one look into the root; sites
// close together go down as far as their keys agree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rondel::order {

class KeyTree {
 public:
  // Keys occupy the upper `key_bits` of 64 bits. The root has 2^root_bits intervals. An interval
  // with more than `most` keys of the sorted sample is cut again as long as there are bits to cut
  // by.
  KeyTree(std::span<const std::uint64_t> sample, int key_bits, int root_bits, std::size_t most);

  [[nodiscard]] std::size_t num_leaves() const { return prefix_bits_.size(); }

  // The interval of a key. Intervals are numbered in the order of the keys.
  [[nodiscard]] std::uint32_t leaf(std::uint64_t key) const {
    std::uint32_t entry = entries_[key >> root_shift_];
    for (int shift = root_shift_; (entry & is_node) != 0;) {
      shift -= child_bits;
      entry = entries_[(entry & ~is_node) + ((key >> shift) & (num_children - 1))];
    }
    return entry;
  }

  // How many of their upper bits the keys of an interval have in common at least.
  [[nodiscard]] int prefix_bits(std::uint32_t leaf) const { return prefix_bits_[leaf]; }
  [[nodiscard]] int longest_prefix_bits() const { return longest_prefix_bits_; }

 private:
  static constexpr int child_bits = 4;
  static constexpr std::uint32_t num_children = 1U << child_bits;
  static constexpr std::uint32_t is_node = 1U << 31;

  void grow(std::span<const std::uint64_t> sample, std::size_t first_entry, int prefix, int bits);

  int key_bits_;
  int root_shift_;
  std::size_t max_keys_;
  std::vector<std::uint32_t> entries_;  // leaves, or is_node | index of the first child
  std::vector<std::uint8_t> prefix_bits_;
  int longest_prefix_bits_ = 0;
};

}  // namespace rondel::order
