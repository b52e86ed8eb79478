// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/geojson_items.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "io/column_text.h"
#include "io/number.h"

namespace rondel::io {
namespace {

using nlohmann::json;

// A feature without a place has the geometry null, or one whose coordinates are empty (RFC 7946,
// sections 3.1 and 3.2).
bool is_unlocated(const JsonTree& geometry) {
  const JsonTree& coordinates = geometry.member("coordinates");
  return geometry.is_null() || (coordinates.is_array() && coordinates.items.empty());
}

// True if the name of a coordinate reference system, such as "urn:ogc:def:crs:OGC:1.3:CRS84" or
// "EPSG:4326", means longitudes from Greenwich and latitudes in degrees: in WGS 84, in NAD 83 or
// ETRS 89, which differ by meters, or on another body.
bool is_in_degrees(const std::string& name) {
  const std::size_t separator = name.find_last_of(":/#");
  const std::string code = separator == std::string::npos ? name : name.substr(separator + 1);
  const std::string authority = name.substr(0, name.size() - code.size());
  if (authority.find("IAU") != std::string::npos) {  // the code is 100 times the body, plus 0 or 2
                                                     // for degrees
    return code.size() > 2 && (code.ends_with("00") || code.ends_with("02"));
  }
  constexpr std::array<std::string_view, 8> known = {"CRS84", "CRS84h", "CRS83", "WGS84",
                                                     "4326",  "4979",   "4269",  "4258"};
  return std::ranges::find(known, code) != known.end();
}

// Throws BadValue unless coordinates are degrees. The member `crs`, which RFC 7946 has removed but
// files still have, has the type "name", "EPSG" or "link".
void require_degrees(const JsonTree& object) {
  const JsonTree& crs = object.member("crs");
  if (crs.is_null()) return;
  const JsonTree& properties = crs.member("properties");
  std::string name;
  for (const char* const member : {"name", "code", "href"}) {
    if (name.empty() && !properties.member(member).is_null()) {
      name = unquoted(properties.member(member));
    }
  }
  if (name.empty()) name = unquoted(crs);
  if (is_in_degrees(name)) return;
  throw BadValue("the member \"crs\" names " + in_quotes(name) +
                 " where longitudes and latitudes in degrees (EPSG:4326) are needed: convert the "
                 "file, as by ogr2ogr -t_srs EPSG:4326, or take the member away if it is wrong");
}

// Returns the word for an element of a list in messages.
std::string_view name_of_item(const std::string& list) {
  return list == "features" ? "feature" : "geometry";
}

}  // namespace

std::string geojson_type(const JsonTree& object) {
  const JsonTree& type = object.member("type");
  return type.is_string() ? type.string() : std::string();
}

std::string unquoted(const JsonTree& value) {
  return value.is_string() ? value.string() : value.text();
}

LonLat geojson_position(const JsonTree& coordinates) {
  const std::vector<JsonTree>& items = coordinates.items;
  const bool are_numbers =
      coordinates.is_array() && items.size() >= 2 && items[0].is_number() && items[1].is_number();
  if (!are_numbers) {
    throw BadValue("coordinates " + in_quotes(coordinates.text()) + " are not [lon, lat]");
  }
  try {
    return checked_position(items[0].number(), items[1].number(), false);
  } catch (const BadValue& bad) {
    throw BadValue("coordinates " + in_quotes(coordinates.text()) + ": " + bad.what());
  }
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

// Members of the root have depth 1, elements of their arrays depth 2.
void GeoJsonItems::read(const ItemListener& listener) {
  const char* const end = bytes_.data() + bytes_.size();
  cursor_.position = bytes_.data();
  JsonTreeBuilder builder({[this](std::size_t depth, const std::string& list) {
                             if (depth == 0 || is_item(depth, list)) item_line_ = cursor_.line;
                             if (is_item(depth, list)) item_ = name_of_item(list);
                           },
                           [&](std::size_t depth, const std::string& list, const JsonTree& object) {
                             if (depth == 1 && list == "crs") {  // before positions are refused
                               JsonTree root;
                               root.members.push_back({list, object});
                               require_degrees(root);
                             }
                             if (!is_item(depth, list)) return false;
                             on_item(list, object, listener);
                             return true;
                           }});
  try {
    json::sax_parse(CursorIterator(bytes_.data(), cursor_), CursorIterator(end, cursor_), &builder);
    // The parser takes the character U+0000 for the end of the text.
    if (bytes_.find('\0') != std::string_view::npos) {
      throw JsonError("not JSON: a byte 0 at position " + std::to_string(bytes_.find('\0')) +
                      " of the file");
    }
  } catch (const JsonError&) {
    item_line_ = 0;
    throw;
  } catch (const BadValue&) {
    if (item_.empty()) throw;
    at_item(item_, num_items_, [] { throw; });
  }
  on_root(builder.root(), listener);
}

void GeoJsonItems::on_item(const std::string& list, const JsonTree& item,
                           const ItemListener& listener) {
  const bool is_feature = list == "features";
  item_ = {};
  at_item(name_of_item(list), num_items_,
          [&] { is_feature ? visit_feature(item, listener) : visit_geometry(item, {}, listener); });
  ++num_items_;
  item_line_ = 0;
}

void GeoJsonItems::on_root(const JsonTree& root, const ItemListener& listener) {
  item_line_ = 1;
  require_degrees(root);
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
    visit_geometry(root, {}, listener);
  }
}

void GeoJsonItems::visit_geometry(const JsonTree& geometry, const JsonTree& feature,
                                  const ItemListener& listener) {
  require_degrees(geometry);
  listener.on_geometry(geometry, feature);
}

void GeoJsonItems::visit_feature(const JsonTree& feature, const ItemListener& listener) {
  const std::string type = geojson_type(feature);
  if (type != "Feature") throw BadValue("type " + in_quotes(type) + " where a Feature is needed");
  if (!feature.has_member("geometry")) throw BadValue("no geometry");
  require_degrees(feature);
  const JsonTree& geometry = feature.member("geometry");
  if (is_unlocated(geometry)) {
    listener.on_unlocated(feature);
  } else {
    visit_geometry(geometry, feature, listener);
  }
}

void PropertyColumns::add(const JsonTree& feature, std::size_t row) {
  for (const auto& [name, value] : feature.member("properties").members) {
    const auto [entry, is_new] = index_.try_emplace(name, columns_.size());
    if (is_new) columns_.push_back(make_column(name));
    Column& column = columns_[entry->second];
    pad(column, row);
    append_cell(column, value.is_null() ? std::string() : unquoted(value));
    if (!value.is_number() && !value.is_null()) column.is_numeric = false;
    pad_kinds(column, row);
    column.is_json.push_back(!value.is_string());
  }
  const JsonTree& id = feature.member("id");
  if (id.is_null()) return;
  pad(ids_, row);
  ids_.text += id.text();
  ids_.ends.push_back(ids_.text.size());
}

void PropertyColumns::forget_ids(std::size_t row) {
  if (ids_.ends.size() <= row) return;
  ids_.ends.resize(row);
  ids_.text.resize(row == 0 ? 0 : ids_.ends.back());
}

void PropertyColumns::finish(std::size_t num_rows) {
  for (Column& column : columns_) {
    pad(column, num_rows);
    pad_kinds(column, num_rows);
    bool is_plain = true;
    for (std::size_t row = 0; row < num_rows; ++row) {
      is_plain = is_plain && column.is_json[row] == (column.is_numeric || column.cell(row).empty());
    }
    if (is_plain) column.is_json = {};
  }
  ids_.is_numeric = true;
  if (!ids_.ends.empty()) pad(ids_, num_rows);
}

}  // namespace rondel::io
