// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Appends features of GeoJSON (RFC 7946). All writers of GeoJSON are made of these functions:
//
//     file.write(features_begin);
//     begin_feature(text, is_first);      each feature: {"type":"Feature","properties":{
//     text += R"("name":1)";              its properties
//     text += geometry_begin;             },"geometry":
//     append_geometry(text, polygons);    its geometry, or null
//     text += '}';
//     file.write(features_end);
//
// Coordinates have the shortest digits that give back the same double, so that regions of any size
// stay valid.
//
// in    positions in degrees; columns of text, with the kinds of their cells
// out   text
// index rows of a column
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/polygon.h"
#include "map/region.h"
#include "rondel/io.h"

namespace rondel::io {

inline constexpr const char* features_begin = R"({"type":"FeatureCollection","features":[)";
inline constexpr const char* features_end = "\n]}\n";
inline constexpr const char* geometry_begin = R"(},"geometry":)";

// Appends what is before the properties of a feature, and before that what separates it from the
// feature before. A feature has an id where the row of `ids` has one.
void begin_feature(std::string& out, bool is_first);
void begin_feature(std::string& out, bool is_first, const Column& ids, std::size_t row);

// Returns `,"name":` for each column, with the names of free_names().
std::vector<std::string> property_keys(std::span<const Column> columns,
                                       std::set<std::string> taken);
// Appends the cell of a row as JSON.
void append_value(std::string& out, const Column& column, std::size_t row);

// Appends a Polygon, or a MultiPolygon where a region is cut at the antimeridian, or null for a
// region that has no polygon.
void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons);
void append_geometry(std::string& out, const std::vector<map::PolygonWithHoles>& polygons);
// Appends the parts of a geometry: a Point, LineString, Polygon or several of them, or a
// GeometryCollection of parts of different kinds, or null where there is no part.
void append_geometry(std::string& out, std::span<const LonLat> points,
                     std::span<const std::vector<LonLat>> lines,
                     const std::vector<map::PolygonWithHoles>& polygons);
// Appends a MultiPolygon, or null where there is no polygon.
void append_multi_polygon(std::string& out, const std::vector<map::PolygonWithHoles>& polygons);
// Appends a MultiLineString, or null for an empty text. `lines` is what append_positions() appends
// for each line, with commas between them.
void append_multi_line(std::string& out, std::string_view lines);
// Appends a Point.
void append_point(std::string& out, const LonLat& position);

// Appends positions as [[lon,lat],...].
void append_positions(std::string& out, std::span<const LonLat> positions);

}  // namespace rondel::io
