// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A build by all ranks, step by step:
//
//     count        which squares each rank triangulates     exchange, all-gather; again where dense
//     deal         the sites to these ranks                 exchange, some at a time
//     triangulate  each rank its squares                    all-gather
//     join         what they left open, by rank 0           exchange, there and back
//     number       the faces, through all ranks             all-gather, exchange
//     finish       duplicates and hidden sites home         exchange, all-gather
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

std::shared_ptr<const DistributedTriangulation::Impl> build_on_ranks(Communicator& ranks,
                                                                     std::span<const Point> mine,
                                                                     const RankLimits& limits,
                                                                     const system::Job& options);

}  // namespace rondel::distributed
