// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The build that delaunay() and convex_hull() share, once their options are validated.
//
// in    sites, options, threads and progress
// out   a triangulation with a report of the work
// index sites in the order of the input
#pragma once

#include <span>

#include "hidden/inner_point.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/job.h"

namespace rondel::api {

// Throws InvalidInput if a site of the projected model is not valid; weighted ones are. `inner`, if
// its user knows one, is a point inside the hull of the sites; it saves looking for one.
Triangulation build(Sites all_sites, const system::Job& options,
                    const hidden::InnerPoint* inner = nullptr);

// Returns the numbers x, y, z, x, y, z ... as points, where they lie. Throws InvalidInput if their
// number is not a multiple of 3.
std::span<const Point> as_points(std::span<const double> xyz);

}  // namespace rondel::api
