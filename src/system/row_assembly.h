// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Assembles compressed rows: from the number of entries of each row, from entries in any order, and
// from blocks of rows that several threads have made. The result does not depend on the threads.
//
// in    counts, entries or blocks
// out   offsets (rondel/compressed_rows.h), and the arrays of the entries
// index rows and entries, from 0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "system/parallel.h"

namespace rondel::system {

// True if the offsets begin with 0, end with `end` and do not decrease.
inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t end) {
  return !offsets.empty() && offsets.front() == 0 && offsets.back() == end &&
         std::ranges::is_sorted(offsets);
}

// True if there are num_rows + 1 of them, too.
inline bool are_offsets(std::span<const std::uint64_t> offsets, std::size_t num_rows,
                        std::size_t end) {
  return offsets.size() == num_rows + 1 && are_offsets(offsets, end);
}

// Replaces counts by offsets: entry i + 1 has the number of entries of row i before, and their end
// afterwards. The first entry is 0 before.
template <class Offset>
void sum_counts(std::vector<Offset>& counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

// Returns the offsets of rows of which count(i) is the number of entries.
template <class Count>
std::vector<std::uint64_t> offsets_of(std::size_t num_rows, const Count& count) {
  std::vector<std::uint64_t> offsets(num_rows + 1, 0);
  for (std::size_t i = 0; i < num_rows; ++i) offsets[i + 1] = offsets[i] + count(i);
  return offsets;
}

// Finds the places of entries that come in any order: first count() is called for the row of each
// entry, then sum(), then place() for each entry in turn. The entries of a row keep their order.
template <class Offset = std::uint64_t>
class RowPlaces {
 public:
  explicit RowPlaces(std::size_t num_rows) : offsets_(num_rows + 2, 0) {}
  void count(std::size_t row) { ++offsets_[row + 2]; }
  // Returns the number of entries.
  std::size_t sum() {
    sum_counts(offsets_);
    return offsets_.back();
  }
  // Returns the place of the next entry of a row. Until it has all of its entries, offsets_[row +
  // 1] is this place, and the end of the row then.
  Offset place(std::size_t row) { return offsets_[row + 1]++; }
  // Returns the offsets, when all entries have their places.
  std::vector<Offset> offsets() && {
    offsets_.pop_back();
    return std::move(offsets_);
  }

 private:
  std::vector<Offset> offsets_;
};

// An array of a block of rows, and that of the result into which its entries are copied.
template <class Block, class T>
struct JoinedColumn {
  std::vector<T> Block::*from;
  std::vector<T>& to;
};
template <class Block, class T>
JoinedColumn(std::vector<T> Block::*, std::vector<T>&) -> JoinedColumn<Block, T>;

// Joins blocks of rows and returns the offsets of all rows; each block is freed when it has been
// copied. `sizes` of a block has the number of entries of each of its rows. row(b, block, k) is
// the number of row k of block b, different for all; rows of no block are empty. An array stays
// empty if it is so in all blocks.
template <class Block, class Row, class... T>
std::vector<std::uint64_t> join_rows(unsigned threads, std::size_t num_rows,
                                     std::vector<Block> blocks, const Row& row,
                                     const JoinedColumn<Block, T>&... columns) {
  std::vector<std::uint64_t> offsets(num_rows + 1, 0);
  parallel_for(threads, blocks.size(), 1, [&](std::size_t b, std::size_t /*end*/) {
    for (std::size_t k = 0; k < blocks[b].sizes.size(); ++k) {
      offsets[row(b, blocks[b], k) + std::size_t{1}] = blocks[b].sizes[k];
    }
  });
  sum_counts(offsets);
  const auto is_used = [&](auto from) {
    return std::ranges::any_of(blocks, [&](const Block& block) { return !(block.*from).empty(); });
  };
  (columns.to.resize(is_used(columns.from) ? offsets.back() : 0), ...);
  parallel_for(threads, blocks.size(), 1, [&](std::size_t b, std::size_t /*end*/) {
    const Block block = std::move(blocks[b]);
    const auto copy = [&](const auto& from, auto& to) {
      if (from.empty()) return;
      auto next = from.begin();
      for (std::size_t k = 0; k < block.sizes.size(); ++k) {
        const auto size = static_cast<std::ptrdiff_t>(block.sizes[k]);
        std::copy_n(next, size,
                    to.begin() + static_cast<std::ptrdiff_t>(offsets[row(b, block, k)]));
        next += size;
      }
    };
    (copy(block.*columns.from, columns.to), ...);
  });
  return offsets;
}

}  // namespace rondel::system
