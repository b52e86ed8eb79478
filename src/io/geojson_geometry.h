// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons as GeoJSON.
#pragma once

#include <string>
#include <vector>

#include "map/polygon.h"

namespace rondel::io {

// Appends a Polygon, or a MultiPolygon where a region is cut at the antimeridian, or null for a
// region that has no polygon. Coordinates have the shortest digits that give back the same double,
// so that regions of any size stay valid.
void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons);

}  // namespace rondel::io
