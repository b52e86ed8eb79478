// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/key_tree.h"

#include <algorithm>

namespace rondel::order {

KeyTree::KeyTree(std::span<const std::uint64_t> sample, int key_bits, int root_bits,
                 std::size_t most)
    : key_bits_(key_bits), root_shift_(64 - root_bits), max_keys_(most) {
  entries_.resize(std::size_t{1} << root_bits);
  grow(sample, 0, 0, root_bits);
}

// Fills the entries of a node whose keys agree in the upper `prefix` bits and differ in the next
// `bits`.
void KeyTree::grow(std::span<const std::uint64_t> sample, std::size_t first_entry, int prefix,
                   int bits) {
  const int shift = 64 - prefix - bits;
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  for (std::uint64_t digit = 0; digit <= mask; ++digit) {
    const auto end = std::ranges::partition_point(
        sample, [&](std::uint64_t key) { return ((key >> shift) & mask) <= digit; });
    const auto count = static_cast<std::size_t>(end - sample.begin());
    if (count > max_keys_ && prefix + bits + child_bits <= key_bits_) {
      const std::size_t children = entries_.size();
      entries_[first_entry + digit] = is_node | static_cast<std::uint32_t>(children);
      entries_.resize(children + num_children);
      grow(sample.first(count), children, prefix + bits, child_bits);
    } else {
      entries_[first_entry + digit] = static_cast<std::uint32_t>(prefix_bits_.size());
      prefix_bits_.push_back(static_cast<std::uint8_t>(prefix + bits));
      longest_prefix_bits_ = std::max(longest_prefix_bits_, prefix + bits);
    }
    sample = sample.subspan(count);
  }
}

}  // namespace rondel::order
