// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A build by all ranks, step by step:
//
//     count        decides which squares each rank triangulates    exchange, all-gather; repeated if dense
//     scatter      sends the sites to these ranks                  exchange, a limited number at a time
//     triangulate  triangulates each rank's squares                all-gather
//     join         joins on rank 0 what they left open             exchange, there and back
//     number       numbers the faces of all ranks                  all-gather, exchange
//     finish       returns duplicates and hidden sites             exchange, all-gather
//
// in    the sites of each rank
// out   each rank's part of the faces
// index sites and faces of all ranks, counted through
#pragma once

#include <memory>
#include <span>

#include "distributed/rank_counts.h"
#include "rondel/distributed.h"
#include "system/job.h"

namespace rondel::distributed {

// Returns this rank's part of the triangulation. Throws the same exception on all ranks.
std::shared_ptr<const DistributedTriangulation::Impl> build_on_ranks(Communicator& ranks,
                                                                     std::span<const Point> mine,
                                                                     const RankLimits& limits,
                                                                     const system::Job& options);

}  // namespace rondel::distributed
