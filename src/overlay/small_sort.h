// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sorts a few different indices without a branch: each of them is compared with each.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "rondel/types.h"
#include "system/wide_vectors.h"

namespace rondel::overlay {

// The places of up to `most` keys in sorted order.
class SmallSort {
 public:
  static constexpr std::size_t most = 32;

  // Computes the places of key(0) ... key(size - 1) in ascending order. Preconditions: size <=
  // most; the keys are different, and none is no_index.
  template <class Key>
  SmallSort(std::size_t size, const Key& key) {
    std::array<Index, most> keys{};
    for (std::size_t k = 0; k < size; ++k) keys[k] = key(k);
    for (std::size_t begin = 0; begin < size; begin += lanes) {
      for (std::size_t i = 0; i < size; ++i) {
        const Index other = keys[i];
        RONDEL_KEEP_LOOP for (std::size_t k = begin; k < begin + lanes; ++k) {
          ranks_[k] += static_cast<Index>(other < keys[k]);
        }
      }
    }
  }
  // Returns the place of key k.
  [[nodiscard]] Index operator[](std::size_t k) const { return ranks_[k]; }

 private:
  static constexpr std::size_t lanes = 8;
  std::array<Index, most> ranks_{};
};

}  // namespace rondel::overlay
