// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The geometries of a GeoJSON document (RFC 7946), one after the other. Features are taken out of the
// document as they come, so that a large file never stands in memory as a tree. A member `crs` that names anything but
// degrees of longitude and latitude is refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/json_tree.h"
#include "rondel/io.h"

namespace rondel::io {

// The member `type`; empty if it is no string.
std::string geojson_type(const JsonTree& object);

// Text of a property: a string without its quotes, anything else as JSON.
std::string unquoted(const JsonTree& value);

class GeoJsonItems {
 public:
  struct ItemListener {
    // Of a feature, or a bare one, which has no properties.
    std::function<void(const JsonTree& geometry, const JsonTree& properties)> on_geometry;
    // Of a feature without a place.
    std::function<void(const JsonTree& properties)> on_unlocated;
  };

  explicit GeoJsonItems(std::string_view bytes) : bytes_(bytes) {}

  // Throws BadValue; line() then tells where. The members of a collection at the root are items, each.
  void read(const ItemListener& listener);
  [[nodiscard]] std::uint64_t line() const { return item_line_ != 0 ? item_line_ : cursor_.line; }
  // How far it has come.
  [[nodiscard]] std::size_t num_bytes_read() const {
    return static_cast<std::size_t>(cursor_.position - bytes_.data());
  }

 private:
  struct TextPosition {
    const char* position = nullptr;
    std::uint64_t line = 1;
  };
  class CursorIterator;

  [[nodiscard]] static bool is_item(std::size_t depth, const std::string& list) {
    return depth == 2 && (list == "features" || list == "geometries");
  }
  void on_item(const std::string& list, const JsonTree& item, const ItemListener& listener);
  void on_root(const JsonTree& root, const ItemListener& listener);
  static void visit_geometry(const JsonTree& geometry, const JsonTree& properties,
                             const ItemListener& listener);
  static void visit_feature(const JsonTree& feature, const ItemListener& listener);

  std::string_view bytes_;
  TextPosition cursor_{};        // of the parser
  std::uint64_t item_line_ = 0;  // of the feature or geometry in work, 0 between them
  std::size_t num_items_ = 0;
};

// Properties, row by row; a column has a cell in every row.
class PropertyColumns {
 public:
  explicit PropertyColumns(std::vector<Column>& columns) : columns_(columns) {}

  void add(const JsonTree& properties, std::size_t row);
  void finish(std::size_t num_rows);

 private:
  static void pad(Column& column, std::size_t size) {
    column.ends.resize(size, column.text.size());
  }

  std::vector<Column>& columns_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace rondel::io
