// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_items.h"

#include <iterator>

#include "io/column_text.h"
#include "io/number.h"

namespace rondel::io {
namespace {

using nlohmann::json;

// RFC 7946, sections 3.1 and 3.2: a feature without a place has the geometry null, or one whose
// coordinates are empty.
bool is_unlocated(const JsonTree& geometry) {
  const JsonTree& coordinates = geometry.member("coordinates");
  return geometry.is_null() || (coordinates.is_array() && coordinates.items.empty());
}

}  // namespace

std::string geojson_type(const JsonTree& object) {
  const JsonTree& type = object.member("type");
  return type.is_string() ? type.string() : std::string();
}

std::string unquoted(const JsonTree& value) {
  return value.is_string() ? value.string() : value.text();
}

// Moves the cursor, which copies of the iterator share, through the text.
class GeoJsonItems::CursorIterator {
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

// The members of the root have depth 1, the elements of their arrays depth 2.
void GeoJsonItems::read(const ItemListener& listener) {
  const char* const end = bytes_.data() + bytes_.size();
  cursor_.position = bytes_.data();
  JsonTreeBuilder builder({[this](std::size_t depth, const std::string& list) {
                             if (depth == 0 || is_item(depth, list)) item_line_ = cursor_.line;
                           },
                           [&](std::size_t depth, const std::string& list, const JsonTree& object) {
                             if (!is_item(depth, list)) return false;
                             on_item(list, object, listener);
                             return true;
                           }});
  try {
    json::sax_parse(CursorIterator(bytes_.data(), cursor_), CursorIterator(end, cursor_), &builder);
  } catch (const JsonError&) {
    item_line_ = 0;
    throw;
  }
  on_root(builder.root(), listener);
}

void GeoJsonItems::on_item(const std::string& list, const JsonTree& item,
                           const ItemListener& listener) {
  const bool is_feature = list == "features";
  at_item(is_feature ? "feature" : "geometry", num_items_,
          [&] { is_feature ? visit_feature(item, listener) : listener.on_geometry(item, {}); });
  ++num_items_;
  item_line_ = 0;
}

void GeoJsonItems::on_root(const JsonTree& root, const ItemListener& listener) {
  item_line_ = 1;
  const std::string type = geojson_type(root);
  const bool is_features = type == "FeatureCollection";
  if (is_features || type == "GeometryCollection") {
    const char* const list = is_features ? "features" : "geometries";
    const JsonTree& rest = root.member(list);
    if (!rest.is_array()) throw BadValue(type + " without an array \"" + list + "\"");
    if (!rest.items.empty())
      throw BadValue(std::string(list) + " has members that are not objects");
  } else if (type == "Feature") {
    visit_feature(root, listener);
  } else {
    listener.on_geometry(root, {});
  }
}

void GeoJsonItems::visit_feature(const JsonTree& feature, const ItemListener& listener) {
  const std::string type = geojson_type(feature);
  if (type != "Feature") throw BadValue("type " + in_quotes(type) + " where a Feature is needed");
  if (!feature.members.contains("geometry")) throw BadValue("no geometry");
  const JsonTree& geometry = feature.member("geometry");
  const JsonTree& properties = feature.member("properties");
  if (is_unlocated(geometry)) {
    listener.on_unlocated(properties);
  } else {
    listener.on_geometry(geometry, properties);
  }
}

void PropertyColumns::add(const JsonTree& properties, std::size_t row) {
  for (const auto& [name, value] : properties.members) {
    const auto [entry, is_new] = index_.try_emplace(name, columns_.size());
    if (is_new) columns_.push_back(make_column(name));
    Column& column = columns_[entry->second];
    pad(column, row);
    append_cell(column, value.is_null() ? std::string() : unquoted(value));
    if (!value.is_number() && !value.is_null()) column.is_numeric = false;
  }
}

void PropertyColumns::finish(std::size_t num_rows) {
  for (Column& column : columns_) pad(column, num_rows);
}

}  // namespace rondel::io
