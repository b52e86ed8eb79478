// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the polygons of a file into cells whose sides are great circles.
#pragma once

#include "map/polygon_features.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Returns cells of which cell i is feature i. A ring of a shell is around its smaller side, and a
// hole is around the part that it removes.
//
// 1. Sides of a feature that lead back and forth between two corners cancel. A feature whose parts
//    cover the sphere is in `whole`.
// 2. FileError is thrown for a ring whose sides all cancel, for holes that leave nothing of their
//    polygon, for parts that overlap, and for sides of a feature that cross.
CellRings geodesic_cells(const map::PolygonFeatures& features, const Execution& execution);

// Throws FileError if a hole of the feature is outside of its polygon or in another hole.
void refuse_geodesic_holes(const map::PolygonFeatures& features, std::size_t feature,
                           const Execution& execution);

}  // namespace rondel::overlay
