// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The build that delaunay() and convex_hull() share, once their options are validated.
//
// in    sites, options, threads and progress
// out   a triangulation with a report of the work, or the parts of one
// index sites in the order of the input
#pragma once

#include <span>
#include <vector>

#include "hidden/inner_point.h"
#include "order/spatial_order.h"
#include "rondel/export.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/job.h"
#include "topology/triangulation_arrays.h"

namespace rondel::api {

// Throws InvalidInput if a site of the projected model is not valid; weighted ones are. `inner`, if
// its user knows one, is a point inside the hull of the sites; it saves looking for one.
Triangulation build(Sites all_sites, const system::Job& options,
                    const hidden::InnerPoint* inner = nullptr);

// What a triangulation is made of, and the spatial order of its sites, on which the canonical order
// of its faces rests.
struct Parts {
  TriangulationArrays arrays;
  BuildReport report;
  std::vector<Index> order;             // as in order::SpatialOrder
  std::vector<order::Renamed> renamed;  // as in order::SpatialOrder
};

// Builds in the projected model. Throws InvalidInput if a site is not valid.
RONDEL_API Parts build_parts(std::span<const Point> sites, const system::Job& options);

// Returns the numbers x, y, z, x, y, z ... as points, where they lie. Throws InvalidInput if their
// number is not a multiple of 3.
std::span<const Point> as_points(std::span<const double> xyz);

}  // namespace rondel::api
