// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Further points on arcs of the diagram that are longer than 120 degrees.
#pragma once

#include <span>
#include <vector>

#include "dual/split_sites.h"

namespace rondel::dual {

// The point on the arc between the circumcenters of two faces, for both halfedges of
// the edge between them.
struct ArcPoint {
  Index halfedge;
  Index point;  // position in Cells::points
};

// Appends the middle of every arc that is too long to `points`, which hold
// the circumcenters, and returns the list sorted by halfedge. Flat two-sided
// hulls have antipodal circumcenters all along their rim.
std::vector<ArcPoint> add_arc_points(const Triangulation& triangulation, const SplitSites& sites,
                                     std::vector<Point>& points);

}  // namespace rondel::dual
