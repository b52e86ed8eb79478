// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/geojson_writer.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "io/number.h"

namespace rondel::io {
namespace {

// Returns the text in quotes, with the escapes of JSON.
std::string json_string(std::string_view text) { return nlohmann::json(text).dump(); }

// Appends [lon,lat] and a comma.
void append_position(std::string& out, const LonLat& position) {
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

// Appends [item,item,...]; there must be an item.
template <class Items, class Append>
void append_list(std::string& out, const Items& items, const Append& append) {
  out += '[';
  for (const auto& item : items) {
    append(item);
    out += ',';
  }
  out.back() = ']';
}

void append_coordinates(std::string& out, const map::LonLatPolygon& polygon) {
  out += '[';
  append_positions(out, polygon.ring);
  out += ']';
}

void append_coordinates(std::string& out, const map::PolygonWithHoles& polygon) {
  append_list(out, polygon.rings,
              [&](const std::vector<LonLat>& ring) { append_positions(out, ring); });
}

template <class P>
void append_all(std::string& out, const std::vector<P>& polygons) {
  out += R"({"type":"MultiPolygon","coordinates":)";
  append_list(out, polygons, [&](const P& polygon) { append_coordinates(out, polygon); });
  out += '}';
}

template <class P>
void append_polygons(std::string& out, const std::vector<P>& polygons) {
  if (polygons.empty()) {
    out += "null";
  } else if (polygons.size() == 1) {
    out += R"({"type":"Polygon","coordinates":)";
    append_coordinates(out, polygons.front());
    out += '}';
  } else {
    append_all(out, polygons);
  }
}

}  // namespace

void begin_feature(std::string& out, bool is_first) { begin_feature(out, is_first, {}, 0); }

void begin_feature(std::string& out, bool is_first, const Column& ids, std::size_t row) {
  out += is_first ? "\n" : ",\n";
  out += R"({"type":"Feature",)";
  if (row < ids.ends.size() && !ids.cell(row).empty()) {
    out += R"("id":)";
    out += ids.cell(row);
    out += ',';
  }
  out += R"("properties":{)";
}

std::vector<std::string> property_keys(std::span<const Column> columns,
                                       std::set<std::string> taken) {
  std::vector<std::string> keys;
  for (const Column& column : columns) keys.push_back(column.name);
  keys = free_names(std::move(keys), std::move(taken));
  for (std::string& key : keys) key = "," + json_string(key) + ":";
  return keys;
}

void append_value(std::string& out, const Column& column, std::size_t row) {
  const std::string_view text = column.cell(row);
  const bool is_json =
      column.is_json.empty() ? column.is_numeric || text.empty() : column.is_json[row];
  if (!is_json) {
    out += json_string(text);
  } else {
    out += text.empty() ? "null" : text;
  }
}

void append_positions(std::string& out, std::span<const LonLat> positions) {
  out += '[';
  for (const LonLat& position : positions) append_position(out, position);
  out.back() = ']';
}

void append_geometry(std::string& out, const std::vector<map::LonLatPolygon>& polygons) {
  append_polygons(out, polygons);
}
void append_geometry(std::string& out, const std::vector<map::PolygonWithHoles>& polygons) {
  append_polygons(out, polygons);
}

void append_geometry(std::string& out, std::span<const LonLat> points,
                     std::span<const std::vector<LonLat>> lines,
                     const std::vector<map::PolygonWithHoles>& polygons) {
  std::vector<std::string> parts;
  if (points.size() == 1) append_point(parts.emplace_back(), points.front());
  if (points.size() > 1) {
    std::string& text = parts.emplace_back(R"({"type":"MultiPoint","coordinates":)");
    append_positions(text, points);
    text += '}';
  }
  if (lines.size() == 1) {
    std::string& text = parts.emplace_back(R"({"type":"LineString","coordinates":)");
    append_positions(text, lines.front());
    text += '}';
  }
  if (lines.size() > 1) {
    std::string& text = parts.emplace_back(R"({"type":"MultiLineString","coordinates":)");
    append_list(text, lines,
                [&](const std::vector<LonLat>& line) { append_positions(text, line); });
    text += '}';
  }
  if (!polygons.empty() || parts.empty()) append_polygons(parts.emplace_back(), polygons);
  if (parts.size() == 1) {
    out += parts.front();
    return;
  }
  out += R"({"type":"GeometryCollection","geometries":)";
  append_list(out, parts, [&](const std::string& part) { out += part; });
  out += '}';
}

void append_multi_polygon(std::string& out, const std::vector<map::PolygonWithHoles>& polygons) {
  if (polygons.empty()) {
    out += "null";
  } else {
    append_all(out, polygons);
  }
}

void append_multi_line(std::string& out, std::string_view lines) {
  if (lines.empty()) {
    out += "null";
    return;
  }
  out += R"({"type":"MultiLineString","coordinates":[)";
  out += lines;
  out += "]}";
}

void append_point(std::string& out, const LonLat& position) {
  out += R"({"type":"Point","coordinates":)";
  append_position(out, position);
  out.back() = '}';
}

}  // namespace rondel::io
