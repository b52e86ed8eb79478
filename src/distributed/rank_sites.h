// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Collects the sites of each bucket on the rank that triangulates it, in the order of their
// indices.
//
// in    the sites of each rank, some at a time
// out   the sites of this rank's buckets, one bucket after the other
// index buckets of this rank, from 0 on; sites of all ranks, counted through
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/bsp_session.h"
#include "distributed/rank_counts.h"
#include "system/large_arrays.h"

namespace rondel::distributed {

// The sites that this rank triangulates.
class RankSites {
 public:
  // Sends and receives the sites. `mine` must outlive this object. The keys in `counts` are not
  // needed afterwards.
  RankSites(BspSession& session, std::span<const Point> mine, RankCounts& counts,
            const RankLimits& limits);

  // Sets the points and the indices, which are increasing, of the sites of one bucket.
  void gather(std::size_t bucket, LargeVector<Point>& points,
              LargeVector<std::uint64_t>& indices) const;

 private:
  // The sites that one rank sent in one round.
  struct ScatteredPiece {
    Bytes bytes;
    std::uint64_t first_index = 0;
    std::vector<Index> begin;           // by bucket: its first site; then the end
    std::span<const std::byte> points;  // part of `bytes`; empty if the points are in `mine_`
    std::span<const std::byte> offsets;
  };

  // Divides a received message into its buckets and appends it to the pieces.
  void add(Bytes message, std::size_t num_buckets, bool has_points,
           std::vector<ScatteredPiece>& pieces);

  std::span<const Point> mine_;
  std::uint64_t first_index_;                        // index of the first site in `mine_`
  std::vector<std::vector<ScatteredPiece>> pieces_;  // by rank, and by round
};

}  // namespace rondel::distributed
