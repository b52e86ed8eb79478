// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/geojson_geometry.h"

#include <array>

#include "io/number_text.h"

namespace rondel::io {
namespace {

// Appends the geometry of any number of polygons.
template <class P>
void append_polygons(std::string& out, const std::vector<P>& polygons) {
  if (polygons.empty()) {
    out += "null";
    return;
  }
  if (polygons.size() == 1) {
    out += R"({"type":"Polygon","coordinates":)";
    append_polygon(out, polygons.front());
    out += '}';
    return;
  }
  out += R"({"type":"MultiPolygon","coordinates":[)";
  for (const P& polygon : polygons) {
    append_polygon(out, polygon);
    out += ',';
  }
  out.back() = ']';
  out += '}';
}

}  // namespace

void append_positions(std::string& out, std::span<const LonLat> positions) {
  out += '[';
  for (const LonLat& position : positions) {
    std::array<char, std::size_t{2} * number_room> text;
    char* end = text.data();
    *end++ = '[';
    end = write_number(end, position.lon_deg);
    *end++ = ',';
    end = write_number(end, position.lat_deg);
    *end++ = ']';
    *end++ = ',';
    out.append(text.data(), end);
  }
  out.back() = ']';
}

// Appends the coordinates of a polygon of one ring.
void append_polygon(std::string& out, const map::LonLatPolygon& polygon) {
  out += '[';
  append_positions(out, polygon.ring);
  out += ']';
}

void append_polygon(std::string& out, const map::PolygonWithHoles& polygon) {
  out += '[';
  for (const std::vector<LonLat>& ring : polygon.rings) {
    append_positions(out, ring);
    out += ',';
  }
  out.back() = ']';
}

void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons) {
  append_polygons(out, polygons);
}
void append_geometry(std::string& out, const std::vector<map::PolygonWithHoles>& polygons) {
  append_polygons(out, polygons);
}

}  // namespace rondel::io
