// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The polygons of files whose sides are great circles.
#pragma once

#include "io/geojson_polygons.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Cell i is feature i. A ring is around its smaller side, a hole around what is not in it.
// 1. Sides of a feature that run to and fro between two corners vanish. A feature whose parts cover the sphere is `whole`.
// 2. A ring whose sides all run to and fro, holes that leave nothing of their polygon, parts that cover a place twice, and sides
//    that cross are refused.
// Throws FileError.
CellRings geodesic_cells(const io::PolygonFeatures& features, const Execution& execution);

}  // namespace rondel::overlay
