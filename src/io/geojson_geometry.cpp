// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/geojson_geometry.h"

#include <array>

#include "io/number_text.h"

namespace rondel::io {
namespace {

// [[[lon,lat],...]]: a polygon is its outer ring alone.
void append_polygon(std::string& out, const map::LonLatPolygon& polygon) {
  out += "[[";
  for (const LonLat& position : polygon.ring) {
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
  out += ']';
}

}  // namespace

void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons) {
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
  for (const map::LonLatPolygon& polygon : polygons) {
    append_polygon(out, polygon);
    out += ',';
  }
  out.back() = ']';
  out += '}';
}

}  // namespace rondel::io
