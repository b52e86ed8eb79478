// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From a constrained triangulation that changes to an immutable one.
//
// in    the places, the hull of dimension 2, the constraints
// out   what constrained_delaunay() returns for them
// index ids of sites and constraints; in the snapshot their positions
#pragma once

#include <vector>

#include "constrained/constrained_hull.h"
#include "constrained/dynamic_constraints.h"
#include "dynamic/places.h"
#include "rondel/dynamic_constrained.h"

namespace rondel::constrained {

ConstrainedSnapshot make_snapshot(const dynamic::Places& places, const ConstrainedHull& hull,
                                  const DynamicConstraints& constraints, const Sphere& sphere);

// Returns the vertices along a constraint of a snapshot, by ids, from one vertex to another.
std::vector<Index> flat_chain(const ConstrainedSnapshot& now, Index constraint, Index first,
                              Index last);

}  // namespace rondel::constrained
