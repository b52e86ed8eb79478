// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features of a file as lines that a mesh follows.
#pragma once

#include <vector>

#include "rondel/feature_cells.h"
#include "rondel/io.h"
#include "rondel/types.h"

namespace rondel::meshing {

// The lines and points of the features, and the outlines of their polygons, which are closed: the last point is the first.
//
// 1. Where one polygon, or closed line, ends at the antimeridian and another, or the same, begins, there is no outline:
//    files cut polygons that cross it, and lead polygons around a pole along it. Outlines go on across the cut.
// 2. A point is a line of one position.
std::vector<std::vector<Point>> outlines_of(const FeatureTable& features);

// Whether the file has features, by its format or its ending; others have sites.
bool is_geojson(const FileName& file);

}  // namespace rondel::meshing
