// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features of a file as lines that a mesh follows.
//
// in    points, lines and polygons of a table of features
// out   lines as unit vectors
// index none: open lines come first, then closed ones, then those that continue across cuts
#pragma once

#include <vector>

#include "rondel/feature_cells.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::meshing {

// Returns the points and lines of the features, and the outlines of their polygons, whose last
// point is the first one.
//
// 1. Where one polygon or closed line ends at the antimeridian and another, or the same, begins,
//    the side along it is no outline, since files cut polygons there, and lead polygons around a
//    pole along it. The outlines continue across the cut.
// 2. A point is a line of one position.
std::vector<std::vector<Point>> outlines_of(const FeatureTable& features);

}  // namespace rondel::meshing
