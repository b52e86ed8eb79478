// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Decides which squares are buckets: as large as they can be with a number of sites that is not
// exceeded. The sites are counted, not sampled, so the number is a guarantee; they come in pieces
// of any size, and more than once where they are dense.
//
// in    the keys of all sites, in any order, round after round
// out   the buckets in the order of the curve, and the bucket of a key
// index buckets; high keys of the curve (order/place_keys.h)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bulk/squares.h"

namespace rondel::distributed {

// A bucket: its square, where it begins on the curve, and how many sites were counted in it.
struct BucketCut {
  bulk::Square square;
  std::uint64_t first_key = 0;  // the lowest one of the square
  std::uint64_t num_sites = 0;
};

class BucketCounts {
 public:
  // 12 MB of counts.
  static constexpr int usual_depth = 9;

  // A bucket has at most this many sites, where copies of a site count. In the first round
  // 6 * 4^depth squares are told apart, on which no result depends.
  explicit BucketCounts(std::uint64_t max_num_sites, int depth = usual_depth);

  // Counts these sites. In each round all sites are counted once.
  void add(std::span<const std::uint64_t> high_keys);
  // Return and set the counts of this round, by squares that depend on the counts of earlier rounds
  // alone. Ranks that count together exchange them, and go on with the sums.
  [[nodiscard]] std::vector<std::uint64_t> counts_of_round() const;
  void set_counts_of_round(std::span<const std::uint64_t> counts);
  // Ends a round. Returns whether another one is needed, in which dense squares are counted finer.
  bool end_round();

  // Returns the buckets, when no round is needed. One that has more sites than it may is as small
  // as a high key can tell, 2^-28 of a face of the cube.
  [[nodiscard]] std::vector<BucketCut> cuts() const;

 private:
  // Counts of the squares into which some squares are split: 4^depth of each.
  struct Table {
    int level;  // of the finer squares, 0 for a face of the cube
    int depth;
    std::vector<std::uint64_t> counts;
    std::vector<Index> finer;  // by square: the number of its table, or no_index
  };

  void refine(Index table);
  // Adds the buckets of a square that has the counts begin ... begin + 4^depth - 1.
  void cut(Index table, const bulk::Square& square, std::uint64_t first_key, std::size_t begin,
           int depth, std::vector<BucketCut>& cuts) const;

  std::uint64_t max_sites_;
  std::size_t num_old_ = 0;  // tables that were counted in earlier rounds
  std::vector<Table> tables_;
};

// Returns the bucket of a key; one of the buckets has it.
std::size_t bucket_of(std::uint64_t high_key, std::span<const BucketCut> cuts);

}  // namespace rondel::distributed
