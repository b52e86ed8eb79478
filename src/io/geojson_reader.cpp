// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites from GeoJSON (RFC 7946): every Point and every member of a MultiPoint, bare, in a geometry
// collection or in features, whose properties become columns. Features are taken out of the
// document as they come, so that a large file never stands in memory as a tree.
#include <cstddef>
#include <iterator>
#include <map>
#include <string>

#include "io/column_text.h"
#include "io/json_tree.h"
#include "io/number.h"
#include "io/site_collector.h"
#include "io/site_formats.h"

namespace rondel::io {
namespace {

using nlohmann::json;

struct TextPosition {
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

  CursorIterator(const char* position, TextPosition& cursor)
      : position_(position), cursor_(&cursor) {}
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
  TextPosition* cursor_;
};

std::string type_of(const JsonTree& object) {
  const JsonTree& type = object.member("type");
  return type.is_string() ? type.string() : std::string();
}

// RFC 7946, sections 3.1 and 3.2: a feature without a place has the geometry null, or one whose
// coordinates are empty.
bool is_unlocated(const JsonTree& geometry) {
  const JsonTree& coordinates = geometry.member("coordinates");
  return geometry.is_null() || (coordinates.is_array() && coordinates.items.empty());
}

std::string unquoted(const JsonTree& value) {
  return value.is_string() ? value.string() : value.text();
}

class PropertyColumns {
 public:
  explicit PropertyColumns(std::vector<Column>& columns) : columns_(columns) {}

  // Adds the properties of site number `site`.
  void add(const JsonTree& properties, std::size_t site) {
    for (const auto& [name, value] : properties.members) {
      const auto [entry, is_new] = index_.try_emplace(name, columns_.size());
      if (is_new) columns_.push_back(make_column(name));
      Column& column = columns_[entry->second];
      pad(column, site);
      append_cell(column, value.is_null() ? std::string() : unquoted(value));
      if (!value.is_number() && !value.is_null()) column.is_numeric = false;
    }
  }

  void finish(std::size_t num_sites) {
    for (Column& column : columns_) pad(column, num_sites);
  }

 private:
  static void pad(Column& column, std::size_t size) {
    column.ends.resize(size, column.text.size());
  }

  std::vector<Column>& columns_;
  std::map<std::string, std::size_t> index_;
};

class GeoJsonReader {
 public:
  GeoJsonReader(std::string_view bytes, const ReadJob& options, SiteTable& table)
      : bytes_(bytes),
        radius_(options.radius),
        keep_columns_(options.keep_columns),
        table_(table),
        collector_(table, options),
        columns_(table.columns) {}

  // Throws BadValue; line() then tells where.
  void read();
  [[nodiscard]] std::uint64_t line() const { return item_line_ != 0 ? item_line_ : cursor_.line; }

 private:
  [[nodiscard]] static bool is_item(std::size_t depth, const std::string& list) {
    return depth == 2 && (list == "features" || list == "geometries");
  }
  void on_item(const std::string& list, const JsonTree& item);
  void on_root(const JsonTree& root);
  void add_feature(const JsonTree& feature);
  void add_geometry(const JsonTree& geometry, const JsonTree& properties);
  void add_coordinates(const JsonTree& coordinates, const JsonTree& properties);
  [[nodiscard]] double radius_in(const JsonTree& properties) const;

  std::string_view bytes_;
  std::string radius_;  // the property
  bool keep_columns_;
  SiteTable& table_;
  SiteCollector collector_;
  PropertyColumns columns_;
  TextPosition cursor_;          // of the parser
  std::uint64_t item_line_ = 0;  // of the feature or geometry in work, 0 between them
  std::size_t num_items_ = 0;
};

// The members of the root have depth 1, the elements of their arrays depth 2.
void GeoJsonReader::read() {
  const char* const end = bytes_.data() + bytes_.size();
  JsonTreeBuilder builder(
      {[this](std::size_t depth, const std::string& list) {
         if (depth == 0 || is_item(depth, list)) item_line_ = cursor_.line;
       },
       [this](std::size_t depth, const std::string& list, const JsonTree& object) {
         if (!is_item(depth, list)) return false;
         on_item(list, object);
         return true;
       }});
  try {
    json::sax_parse(CursorIterator(bytes_.data(), cursor_), CursorIterator(end, cursor_), &builder);
  } catch (const JsonError&) {
    item_line_ = 0;
    throw;
  }
  on_root(builder.root());
  columns_.finish(collector_.size());
}

void GeoJsonReader::on_item(const std::string& list, const JsonTree& item) {
  const bool is_feature = list == "features";
  at_item(is_feature ? "feature" : "geometry", num_items_,
          [&] { is_feature ? add_feature(item) : add_geometry(item, {}); });
  ++num_items_;
  item_line_ = 0;
}

void GeoJsonReader::on_root(const JsonTree& root) {
  item_line_ = 1;
  const std::string type = type_of(root);
  const bool is_features = type == "FeatureCollection";
  if (is_features || type == "GeometryCollection") {
    const char* const list = is_features ? "features" : "geometries";
    const JsonTree& rest = root.member(list);
    if (!rest.is_array()) throw BadValue(type + " without an array \"" + list + "\"");
    if (!rest.items.empty())
      throw BadValue(std::string(list) + " has members that are not objects");
  } else if (type == "Feature") {
    add_feature(root);
  } else {
    add_geometry(root, {});
  }
}

void GeoJsonReader::add_feature(const JsonTree& feature) {
  const std::string type = type_of(feature);
  if (type != "Feature") throw BadValue("type " + in_quotes(type) + " where a Feature is needed");
  if (!feature.members.contains("geometry")) throw BadValue("no geometry");
  const JsonTree& geometry = feature.member("geometry");
  if (is_unlocated(geometry)) {
    ++table_.num_unlocated;
  } else {
    add_geometry(geometry, feature.member("properties"));
  }
}

void GeoJsonReader::add_geometry(const JsonTree& geometry, const JsonTree& properties) {
  const std::string type = type_of(geometry);
  const JsonTree& coordinates = geometry.member("coordinates");
  if (type == "Point") return add_coordinates(coordinates, properties);
  const bool is_collection = type == "GeometryCollection";
  if (!is_collection && type != "MultiPoint") {
    throw BadValue("type " + in_quotes(type) + " where a Point is needed");
  }
  const JsonTree& members = is_collection ? geometry.member("geometries") : coordinates;
  if (!members.is_array()) throw BadValue(type + " without members");
  for (const JsonTree& part : members.items) {
    // Collections in collections are not Points: this bounds the recursion.
    if (is_collection && type_of(part) == type) throw BadValue("nested GeometryCollection");
    if (is_collection) {
      add_geometry(part, properties);
    } else {
      add_coordinates(part, properties);
    }
  }
}

void GeoJsonReader::add_coordinates(const JsonTree& coordinates, const JsonTree& properties) {
  if (!coordinates.is_array() || coordinates.items.size() < 2 ||
      !coordinates.items[0].is_number() || !coordinates.items[1].is_number()) {
    throw BadValue("coordinates " + in_quotes(coordinates.text()) + " are not [lon, lat]");
  }
  if (keep_columns_) columns_.add(properties, collector_.size());
  collector_.add_position(coordinates.items[0].number(), coordinates.items[1].number(), line());
  if (!radius_.empty()) collector_.make_circle(radius_in(properties));
  collector_.report_progress(static_cast<std::size_t>(cursor_.position - bytes_.data()),
                             bytes_.size());
}

double GeoJsonReader::radius_in(const JsonTree& properties) const {
  const JsonTree& value = properties.member(radius_);
  if (value.is_null()) throw BadValue("no property " + in_quotes(radius_));
  if (value.is_number()) return value.number();
  return parse_number(unquoted(value), "radius");
}

}  // namespace

void read_geojson(std::string_view bytes, const ReadJob& options, SiteTable& table) {
  GeoJsonReader reader(bytes, options, table);
  at_line_of(reader, [&] { reader.read(); });
}

}  // namespace rondel::io
