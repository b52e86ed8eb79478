// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_lines.h"

#include <array>
#include <string_view>

#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/geojson_items.h"
#include "io/number.h"

namespace rondel::io {
namespace {

struct LineFormat {
  std::string_view ending;
};
constexpr std::array<LineFormat, 2> line_formats = {{{".geojson"}, {".json"}}};

// In so many arrays lie the positions of a geometry.
struct Nesting {
  std::string_view type;
  int depth;
};
constexpr std::array<Nesting, 6> nestings = {{{"Point", 0},
                                              {"MultiPoint", 1},
                                              {"LineString", 1},
                                              {"MultiLineString", 2},
                                              {"Polygon", 2},
                                              {"MultiPolygon", 3}}};

class LineReader {
 public:
  LineReader(std::string_view bytes, std::vector<std::vector<LonLat>>& lines)
      : items_(bytes), lines_(lines) {}

  void read() {
    items_.read(
        {[this](const JsonTree& geometry, const JsonTree&) { add_geometry(geometry, true); },
         [](const JsonTree&) {}});
  }
  [[nodiscard]] std::uint64_t line() const { return items_.line(); }

 private:
  void add_geometry(const JsonTree& geometry, bool may_be_collection) {
    const std::string type = geojson_type(geometry);
    for (const Nesting& nesting : nestings) {
      if (type != nesting.type) continue;
      add_positions(geometry.member("coordinates"), nesting.depth, type == "MultiPoint");
      return;
    }
    if (type != "GeometryCollection" || !may_be_collection) {
      throw BadValue("type " + in_quotes(type) + " where lines, polygons or points are needed");
    }
    const JsonTree& members = geometry.member("geometries");
    if (!members.is_array()) throw BadValue("GeometryCollection without members");
    for (const JsonTree& part : members.items) add_geometry(part, false);
  }

  void add_positions(const JsonTree& coordinates, int depth, bool is_apart) {
    if (depth == 0) {
      lines_.push_back({line_position(coordinates)});
      return;
    }
    if (!coordinates.is_array()) throw BadValue("a geometry without an array of coordinates");
    if (depth > 1 || is_apart) {
      for (const JsonTree& part : coordinates.items) add_positions(part, depth - 1, false);
      return;
    }
    std::vector<LonLat> positions;
    for (const JsonTree& item : coordinates.items) positions.push_back(line_position(item));
    if (!positions.empty()) lines_.push_back(std::move(positions));
  }

  static LonLat line_position(const JsonTree& item) {
    if (!item.is_array() || item.items.size() < 2 || !item.items[0].is_number() ||
        !item.items[1].is_number()) {
      throw BadValue("coordinates " + in_quotes(item.text()) + " are not [lon, lat]");
    }
    return checked_position(item.items[0].number(), item.items[1].number(), false);
  }

  GeoJsonItems items_;
  std::vector<std::vector<LonLat>>& lines_;
};

}  // namespace

std::vector<std::vector<LonLat>> read_line_features(const FileName& file) {
  FileBytes bytes(file.path);
  std::vector<std::vector<LonLat>> lines;
  (void)require_format<LineFormat>(line_formats, file, "lines are read from");
  if (bytes.head().empty()) throw FileError(bytes.name() + ": the file is empty");
  in_file(bytes.name(), [&] {
    LineReader reader(bytes.text(), lines);
    at_line_of(reader, [&] { reader.read(); });
  });
  return lines;
}

}  // namespace rondel::io
