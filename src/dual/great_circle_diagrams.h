// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Diagrams of sites on one great circle (dimension 1) and of fewer than two vertices.
//
// The vertices v_0 ... v_{k-1} form a convex polygon, counterclockwise about the axis N of
// the circle's plane. The cell of v is a lune from -N to N, its two sides lie in the planes
// perpendicular to the polygon's edges at v. In the middle of a side is the outward normal e x N of
// the edge e. Two vertices share the sphere in hemispheres.
#pragma once

#include <vector>

#include "dual/split_sites.h"
#include "rondel/diagram.h"

namespace rondel::dual {

// Precondition of all: triangulation.dimension() < 2.
Cells great_circle_cells(const Triangulation& triangulation, const SplitSites& sites);
std::vector<double> great_circle_areas(const Triangulation& triangulation, const SplitSites& sites);
std::vector<Point> great_circle_centroids(const Triangulation& triangulation,
                                          const SplitSites& sites);

}  // namespace rondel::dual
