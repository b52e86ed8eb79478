// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_polygons.h"

#include <array>
#include <string_view>

#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/geojson_items.h"
#include "io/number.h"

namespace rondel::io {
namespace {

struct PolygonFormat {
  std::string_view ending;
};
constexpr std::array<PolygonFormat, 2> polygon_formats = {{{".geojson"}, {".json"}}};

class PolygonReader {
 public:
  PolygonReader(std::string_view bytes, PolygonFeatures& features)
      : items_(bytes), features_(features), columns_(features.columns) {}

  void read() {
    items_.read({[this](const JsonTree& geometry, const JsonTree& properties) {
                   begin(properties);
                   add_geometry(geometry, true);
                 },
                 [this](const JsonTree& properties) { begin(properties); }});
    columns_.finish(features_.rings.size());
  }
  [[nodiscard]] std::uint64_t line() const { return items_.line(); }

 private:
  void begin(const JsonTree& properties) {
    columns_.add(properties, features_.rings.size());
    features_.rings.emplace_back();
    features_.lines.push_back(line());
  }

  void add_geometry(const JsonTree& geometry, bool may_be_collection) {
    const std::string type = geojson_type(geometry);
    if (type == "Polygon") return add_polygon(geometry.member("coordinates"));
    if (type == "MultiPolygon") {
      const JsonTree& polygons = geometry.member("coordinates");
      if (!polygons.is_array()) throw BadValue("MultiPolygon without an array of coordinates");
      for (const JsonTree& polygon : polygons.items) add_polygon(polygon);
      return;
    }
    if (type != "GeometryCollection" || !may_be_collection) {
      throw BadValue("type " + in_quotes(type) + " where a Polygon is needed");
    }
    const JsonTree& members = geometry.member("geometries");
    if (!members.is_array()) throw BadValue("GeometryCollection without members");
    for (const JsonTree& part : members.items) add_geometry(part, false);
  }

  void add_polygon(const JsonTree& polygon) {
    if (!polygon.is_array()) throw BadValue("Polygon without an array of coordinates");
    bool is_hole = false;
    for (const JsonTree& ring : polygon.items) {
      features_.rings.back().push_back({positions_of(ring), is_hole});
      is_hole = true;
    }
  }

  static std::vector<LonLat> positions_of(const JsonTree& ring) {
    if (!ring.is_array()) throw BadValue("a ring that is no array");
    std::vector<LonLat> positions;
    positions.reserve(ring.items.size());
    for (const JsonTree& item : ring.items) positions.push_back(position_of(item));
    if (positions.size() < 4) {
      throw BadValue("a ring of " + std::to_string(positions.size()) + " positions");
    }
    if (!(positions.front() == positions.back())) throw BadValue("a ring that is not closed");
    positions.pop_back();
    return positions;
  }

  static LonLat position_of(const JsonTree& item) {
    if (!item.is_array() || item.items.size() < 2 || !item.items[0].is_number() ||
        !item.items[1].is_number()) {
      throw BadValue("coordinates " + in_quotes(item.text()) + " are not [lon, lat]");
    }
    return checked_position(item.items[0].number(), item.items[1].number(), false);
  }

  GeoJsonItems items_;
  PolygonFeatures& features_;
  PropertyColumns columns_;
};

}  // namespace

PolygonFeatures read_polygon_features(const FileName& file) {
  FileBytes bytes(file.path);
  PolygonFeatures features;
  features.name = bytes.name();
  (void)require_format<PolygonFormat>(polygon_formats, file, "polygons are read from");
  if (bytes.head().empty()) throw FileError(features.name + ": the file is empty");
  in_file(features.name, [&] {
    PolygonReader reader(bytes.text(), features);
    at_line_of(reader, [&] { reader.read(); });
  });
  return features;
}

}  // namespace rondel::io
