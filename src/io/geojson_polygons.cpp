// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_polygons.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

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

// Collects the rings and lines of features.
class PolygonReader {
 public:
  PolygonReader(std::string_view bytes, FeatureKinds kinds, FaultyRings faulty,
                map::PolygonFeatures& features)
      : items_(bytes),
        kinds_(kinds),
        faulty_(faulty),
        features_(features),
        columns_(features.files.front().columns, features.files.front().ids) {}

  void read() {
    items_.read({[this](const JsonTree& geometry, const JsonTree& feature) {
                   begin(feature);
                   add_geometry(geometry);
                 },
                 [this](const JsonTree& feature) { begin(feature); }});
    columns_.finish(features_.rings.size());
  }
  [[nodiscard]] std::uint64_t line() const { return items_.line(); }

 private:
  // Begins a row for a feature or bare geometry.
  void begin(const JsonTree& feature) {
    columns_.add(feature, features_.rings.size());
    features_.rings.emplace_back();
    features_.lines.emplace_back();
  }

  // Collections may be nested as deep as the text may be.
  void add_geometry(const JsonTree& geometry) {
    const std::string type = geojson_type(geometry);
    if (type == "Polygon") return add_polygon(geometry.member("coordinates"));
    if (type == "MultiPolygon") {
      for (const JsonTree& polygon : parts_of(geometry, type)) add_polygon(polygon);
      return;
    }
    if (kinds_ == FeatureKinds::all && add_line(geometry, type)) return;
    if (type != "GeometryCollection") {
      throw BadValue("type " + in_quotes(type) + " where a " +
                     (kinds_ == FeatureKinds::all ? "geometry" : "Polygon") + " is needed");
    }
    const JsonTree& members = geometry.member("geometries");
    if (!members.is_array()) throw BadValue("GeometryCollection without members");
    for (const JsonTree& part : members.items) add_geometry(part);
  }

  // Returns the members of a geometry of several parts.
  static const std::vector<JsonTree>& parts_of(const JsonTree& geometry, const std::string& type) {
    const JsonTree& parts = geometry.member("coordinates");
    if (!parts.is_array()) throw BadValue(type + " without an array of coordinates");
    return parts.items;
  }

  // Adds the geometry if it consists of lines or points; returns false otherwise.
  bool add_line(const JsonTree& geometry, const std::string& type) {
    auto& lines = features_.lines.back();
    if (type == "Point") {
      lines.push_back({geojson_position(geometry.member("coordinates"))});
    } else if (type == "MultiPoint") {
      for (const JsonTree& point : parts_of(geometry, type))
        lines.push_back({geojson_position(point)});
    } else if (type == "LineString") {
      lines.push_back(line_of(geometry.member("coordinates")));
    } else if (type == "MultiLineString") {
      for (const JsonTree& line : parts_of(geometry, type)) lines.push_back(line_of(line));
    } else {
      return false;
    }
    return true;
  }

  // Returns the positions of a line, two or more.
  static std::vector<LonLat> line_of(const JsonTree& line) {
    if (!line.is_array()) throw BadValue("a line that is no array");
    if (line.items.size() < 2) {
      throw BadValue("a line of " + std::to_string(line.items.size()) + " positions");
    }
    std::vector<LonLat> positions;
    for (const JsonTree& item : line.items) positions.push_back(geojson_position(item));
    return positions;
  }

  // Adds the rings of a polygon: its outline and then its holes.
  void add_polygon(const JsonTree& polygon) {
    if (!polygon.is_array()) throw BadValue("Polygon without an array of coordinates");
    bool is_hole = false;
    for (const JsonTree& ring : polygon.items) {
      features_.rings.back().push_back(ring_of(ring, is_hole));
      is_hole = true;
    }
  }

  // Returns a ring without its last position, which is the first one again.
  [[nodiscard]] map::LonLatRing ring_of(const JsonTree& ring, bool is_hole) const {
    if (!ring.is_array()) throw BadValue("a ring that is no array");
    std::vector<LonLat> positions;
    positions.reserve(ring.items.size());
    for (const JsonTree& item : ring.items) positions.push_back(geojson_position(item));
    map::LonLatRing result = map::ring_of_file(std::move(positions), is_hole);
    if (!result.fault.empty() && faulty_ == FaultyRings::error) {
      const bool is_open = result.positions.size() > 3;
      throw BadValue(result.fault +
                     (is_open ? "; --invalid repair (invalid='repair' in Python) closes it" : ""));
    }
    return result;
  }

  GeoJsonItems items_;
  FeatureKinds kinds_;
  FaultyRings faulty_;
  map::PolygonFeatures& features_;
  PropertyColumns columns_;
};

}  // namespace

map::PolygonFeatures read_polygon_features(const FileName& file, FeatureKinds kinds,
                                           FaultyRings faulty) {
  FileBytes bytes(file);
  map::PolygonFeatures features;
  features.files.front().name = bytes.name();
  (void)require_format<PolygonFormat>(polygon_formats, file, "polygons are read from");
  if (bytes.head().empty()) throw FileError(features.files.front().name + ": the file is empty");
  in_file(features.files.front().name, [&] {
    PolygonReader reader(bytes.text(), kinds, faulty, features);
    at_line_of(reader, [&] { reader.read(); });
  });
  return features;
}

}  // namespace rondel::io
