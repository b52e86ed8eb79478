// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Areas and circumcenters of a rank's part of a triangulation, in every bit those of the whole: all faces
// around the rank's sites are there, with their numbers and their corners' points.
//
// in    what a rank keeps of a triangulation, with points
// out   areas of the sites that each rank gave; circumcenters of the rank's faces, in their order
// index sites of all ranks, counted through; those that a rank gave, from 0 on
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "distributed/rank_result.h"
#include "distributed/supersteps.h"

namespace rondel::distributed {

// Throws InvalidInput without points, as the next one does.
std::vector<double> areas_on_ranks(Supersteps& steps,
                                   const DistributedTriangulation::Impl& triangulation,
                                   const Execution& execution);

void visit_circumcenters(const DistributedTriangulation::Impl& triangulation,
                         const Execution& execution,
                         const std::function<void(std::span<const Point>)>& visit);

}  // namespace rondel::distributed
