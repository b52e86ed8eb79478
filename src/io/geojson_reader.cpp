// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites from GeoJSON (RFC 7946): every Point and every member of a MultiPoint, bare, in a geometry
// collection or in features, whose properties become columns. Features are taken out of the
// document as they come, so that a large file never stands in memory as a tree.
#include <cstddef>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "io/column_text.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"
#include "rondel/error.h"

namespace rondel::io {
namespace {

using nlohmann::json;

struct Cursor {
  const char* position = nullptr;
  std::uint64_t line = 1;
};

// Moves the cursor, which copies of the iterator share, through the text.
class CursorIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CursorIterator(const char* position, Cursor& cursor) : position_(position), cursor_(&cursor) {}
  reference operator*() const { return *position_; }
  CursorIterator& operator++() {
    if (*position_ == '\n') ++cursor_->line;
    cursor_->position = ++position_;
    return *this;
  }
  friend bool operator==(const CursorIterator& a, const CursorIterator& b) {
    return a.position_ == b.position_;
  }

 private:
  const char* position_;
  Cursor* cursor_;
};

// The member of an object, null if there is none.
const json& member(const json& object, const char* name) {
  static const json null;
  if (!object.is_object()) return null;
  const auto found = object.find(name);
  return found == object.end() ? null : *found;
}

std::string type_of(const json& object) {
  const json& type = member(object, "type");
  return type.is_string() ? type.get<std::string>() : std::string();
}

class PropertyColumns {
 public:
  explicit PropertyColumns(std::vector<Column>& columns) : columns_(columns) {}

  // Adds the properties of site number `site`.
  void add(const json& properties, std::size_t site) {
    if (!properties.is_object()) return;
    for (const auto& [name, value] : properties.items()) {
      const auto [entry, is_new] = index_.try_emplace(name, columns_.size());
      if (is_new) columns_.push_back(make_column(name));
      Column& column = columns_[entry->second];
      pad(column, site);
      append_cell(column, text(value));
      if (!value.is_number() && !value.is_null()) column.is_numeric = false;
    }
  }

  void finish(std::size_t num_sites) {
    for (Column& column : columns_) pad(column, num_sites);
  }

 private:
  static std::string text(const json& value) {
    if (value.is_null()) return {};
    return value.is_string() ? value.get<std::string>() : value.dump();
  }

  static void pad(Column& column, std::size_t size) {
    column.ends.resize(size, column.text.size());
  }

  std::vector<Column>& columns_;
  std::map<std::string, std::size_t> index_;
};

class GeoJsonReader {
 public:
  GeoJsonReader(std::string_view bytes, const ReadOptions& options, SiteTable& table)
      : bytes_(bytes),
        radius_(options.radius),
        keep_columns_(options.keep_columns),
        collector_(table, options),
        columns_(table.columns) {}

  // Throws BadValue; line() then tells where.
  void read();
  [[nodiscard]] std::uint64_t line() const { return item_line_ != 0 ? item_line_ : cursor_.line; }

 private:
  bool on_event(int depth, json::parse_event_t event, json& parsed);
  void on_item(const json& item);
  void on_root(const json& root);
  void add_feature(const json& feature);
  void add_geometry(const json& geometry, const json& properties);
  void add_coordinates(const json& coordinates, const json& properties);
  [[nodiscard]] double radius_in(const json& properties) const;

  std::string_view bytes_;
  std::string radius_;  // the property
  bool keep_columns_;
  SiteCollector collector_;
  PropertyColumns columns_;
  Cursor cursor_;                // of the parser
  std::uint64_t item_line_ = 0;  // of the feature or geometry in work, 0 between them
  std::size_t num_items_ = 0;
  std::string list_;  // the member of the root in work: "features", "geometries" ...
};

void GeoJsonReader::read() {
  const char* const end = bytes_.data() + bytes_.size();
  const auto callback = [this](int depth, json::parse_event_t event, json& parsed) {
    return on_event(depth, event, parsed);
  };
  try {
    const json root =
        json::parse(CursorIterator(bytes_.data(), cursor_), CursorIterator(end, cursor_), callback);
    on_root(root);
  } catch (const json::exception& error) {
    item_line_ = 0;
    // Without "[json.exception.parse_error.101] parse error at line 1, column 2: "
    std::string_view reason = error.what();
    reason.remove_prefix(std::min(reason.find("] ") + 2, reason.size()));
    if (reason.starts_with("parse error at")) reason.remove_prefix(reason.find(": ") + 2);
    throw BadValue("not JSON: " + one_line(reason, 200));
  }
  columns_.finish(collector_.size());
}

// The members of the root have depth 1, the elements of their arrays depth 2.
bool GeoJsonReader::on_event(int depth, json::parse_event_t event, json& parsed) {
  using Event = json::parse_event_t;
  if (event == Event::key && depth == 1) list_ = parsed.get<std::string>();
  const bool is_item = depth == 2 && (list_ == "features" || list_ == "geometries");
  if (event == Event::object_start && (is_item || depth == 0)) item_line_ = cursor_.line;
  if (event != Event::object_end || !is_item) return true;
  on_item(parsed);
  ++num_items_;
  item_line_ = 0;
  return false;
}

void GeoJsonReader::on_item(const json& item) {
  const bool is_feature = list_ == "features";
  try {
    if (is_feature) {
      add_feature(item);
    } else {
      add_geometry(item, {});
    }
  } catch (const BadValue& bad) {
    throw BadValue((is_feature ? "feature " : "geometry ") + std::to_string(num_items_) + ": " +
                   bad.what());
  }
}

void GeoJsonReader::on_root(const json& root) {
  item_line_ = 1;
  const std::string type = type_of(root);
  const bool is_features = type == "FeatureCollection";
  if (is_features || type == "GeometryCollection") {
    const char* const list = is_features ? "features" : "geometries";
    const json& rest = member(root, list);
    if (!rest.is_array()) throw BadValue(type + " without an array \"" + list + "\"");
    if (!rest.empty()) throw BadValue(std::string(list) + " has members that are not objects");
  } else if (type == "Feature") {
    add_feature(root);
  } else {
    add_geometry(root, {});
  }
}

void GeoJsonReader::add_feature(const json& feature) {
  const std::string type = type_of(feature);
  if (type != "Feature") throw BadValue("type " + in_quotes(type) + " where a Feature is needed");
  if (member(feature, "geometry").is_null()) throw BadValue("no geometry");
  add_geometry(member(feature, "geometry"), member(feature, "properties"));
}

void GeoJsonReader::add_geometry(const json& geometry, const json& properties) {
  const std::string type = type_of(geometry);
  const json& coordinates = member(geometry, "coordinates");
  if (type == "Point") return add_coordinates(coordinates, properties);
  const bool is_collection = type == "GeometryCollection";
  if (!is_collection && type != "MultiPoint") {
    throw BadValue("type " + in_quotes(type) + " where a Point is needed");
  }
  const json& members = is_collection ? member(geometry, "geometries") : coordinates;
  if (!members.is_array()) throw BadValue(type + " without members");
  for (const json& part : members) {
    // Collections in collections are not Points: this bounds the recursion.
    if (is_collection && type_of(part) == type) throw BadValue("nested GeometryCollection");
    if (is_collection) {
      add_geometry(part, properties);
    } else {
      add_coordinates(part, properties);
    }
  }
}

void GeoJsonReader::add_coordinates(const json& coordinates, const json& properties) {
  if (!coordinates.is_array() || coordinates.size() < 2 || !coordinates[0].is_number() ||
      !coordinates[1].is_number()) {
    throw BadValue("coordinates " + in_quotes(coordinates.dump()) + " are not [lon, lat]");
  }
  if (keep_columns_) columns_.add(properties, collector_.size());
  collector_.add_position(coordinates[0].get<double>(), coordinates[1].get<double>(), line());
  if (!radius_.empty()) collector_.make_circle(radius_in(properties));
  collector_.report_progress(static_cast<std::size_t>(cursor_.position - bytes_.data()),
                             bytes_.size());
}

double GeoJsonReader::radius_in(const json& properties) const {
  const json& value = member(properties, radius_.c_str());
  if (value.is_null()) throw BadValue("no property " + in_quotes(radius_));
  if (value.is_number()) return value.get<double>();
  return parse_number(value.is_string() ? value.get<std::string>() : value.dump(), "radius");
}

}  // namespace

void read_geojson(std::string_view bytes, const ReadOptions& options, SiteTable& table) {
  if (bytes.empty()) throw FileError(table.name + ": the file is empty");
  GeoJsonReader reader(bytes, options, table);
  try {
    reader.read();
  } catch (const BadValue& bad) {
    throw FileError(table.name + ":" + std::to_string(reader.line()) + ": " + bad.what());
  }
  if (table.sites.empty()) throw FileError(table.name + ": no sites");
}

}  // namespace rondel::io
