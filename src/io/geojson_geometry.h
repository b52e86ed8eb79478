// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Appends polygons as GeoJSON.
//
// in    polygons with longitudes and latitudes in degrees
// out   text
#pragma once

#include <span>
#include <string>
#include <vector>

#include "map/polygon.h"
#include "map/region.h"

namespace rondel::io {

// Appends a Polygon, or a MultiPolygon where a region is cut at the antimeridian, or null for a
// region that has no polygon. Coordinates have the shortest digits that give back the same double,
// so that regions of any size stay valid.
void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons);
void append_geometry(std::string& out, const std::vector<map::PolygonWithHoles>& polygons);

// Appends positions as [[lon,lat],...].
void append_positions(std::string& out, std::span<const LonLat> positions);

// Appends the coordinates of a Polygon.
void append_polygon(std::string& out, const map::LonLatPolygon& polygon);
void append_polygon(std::string& out, const map::PolygonWithHoles& polygon);

}  // namespace rondel::io
