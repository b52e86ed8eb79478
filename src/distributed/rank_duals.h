// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes areas and circumcenters of a rank's part of a triangulation, with the same bits as for
// the whole: all faces around the rank's sites are present, with their numbers and the points of
// their corners.
//
// in    what a rank keeps of a triangulation, with points
// out   areas of the sites that each rank gave; circumcenters of the rank's faces, in their order
// index sites of all ranks, counted through; those that a rank gave, from 0 on
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "distributed/bsp_session.h"
#include "distributed/rank_result.h"

namespace rondel::distributed {

// Returns the areas of the sites that this rank gave. Both functions throw InvalidInput if points
// were not kept.
std::vector<double> areas_on_ranks(BspSession& session,
                                   const DistributedTriangulation::Impl& triangulation,
                                   const Execution& execution);

// Calls visit() with the circumcenters of the rank's faces, in their order, some at a time.
void visit_circumcenters(const DistributedTriangulation::Impl& triangulation,
                         const Execution& execution,
                         const std::function<void(std::span<const Point>)>& visit);

}  // namespace rondel::distributed
