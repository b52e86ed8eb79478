// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Welds features that touch up to rounding. Where a corner of one should be on a side of another one,
// rounded numbers leave a gap, or an overlap, of some units in the last decimal. A refinement would
// fill it with triangles that are as small.
//
// in    sites and constraints, and how near is too near at each place
// out   the same, without sites that are too near to another one, and with constraints that run through
//       the sites that are too near to them
// index sites and constraints
#pragma once

#include <functional>

#include "rondel/constrained_features.h"
#include "rondel/types.h"

namespace rondel::meshing {

// `near_at` returns a distance on the unit sphere. Sites keep their coordinates and their order.
void weld(FeatureConstraints& features, const std::function<double(const Point&)>& near_at);

}  // namespace rondel::meshing
