// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Joins on one rank what the buckets of all ranks left open.
//
// in    the open sites and edges of each rank
// out   for each rank, the faces between buckets that it needs; below dimension 2 the ring
// index ranks
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "distributed/joined_part.h"
#include "distributed/rank_counts.h"

namespace rondel::distributed {

// The data that all ranks receive. In dimension 2 the part of the rank follows; in lower dimensions
// rank 0 receives the ring, the hidden sites and, if points are kept, the areas.
struct JoinedReport {
  int dimension = -1;
  std::uint64_t num_ghost_faces = 0;
};

// Returns the message for each rank, given what write_open_buckets() returned on each rank.
std::vector<Bytes> join_ranks(std::vector<Bytes> received, const RankCounts& counts,
                              bool keep_points, const system::Job& options);

}  // namespace rondel::distributed
