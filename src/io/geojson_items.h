// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the geometries of a GeoJSON document (RFC 7946) one after the other. Features are removed
// from the document as they are read, so that no large file is in memory as a tree. A member `crs`
// is refused unless it names longitudes and latitudes in degrees.
//
// in    the text of a document
// out   a call for each geometry, with its properties
// index features, or bare geometries, in the order of the document
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

// Returns the member `type`; an empty text if it is not a string.
std::string geojson_type(const JsonTree& object);

// Returns the text of a property: a string without its quotes, anything else as JSON.
std::string unquoted(const JsonTree& value);

// Returns the longitude and latitude of a position. Throws BadValue, with the position in the
// message.
LonLat geojson_position(const JsonTree& coordinates);

class GeoJsonItems {
 public:
  // The functions that are called as the document is read.
  struct ItemListener {
    // Called for the geometry of a feature, and for a bare geometry, whose feature is null.
    std::function<void(const JsonTree& geometry, const JsonTree& feature)> on_geometry;
    // Called for a feature without a place.
    std::function<void(const JsonTree& feature)> on_unlocated;
  };

  explicit GeoJsonItems(std::string_view bytes) : bytes_(bytes) {}

  // Reads the document. Throws BadValue; line() is then where. If the root is a collection, each of
  // its members is an item.
  void read(const ItemListener& listener);
  [[nodiscard]] std::uint64_t line() const { return item_line_ != 0 ? item_line_ : cursor_.line; }
  // Returns the number of the current feature or geometry.
  [[nodiscard]] std::uint64_t number() const { return num_items_; }
  // Returns how many bytes have been read.
  [[nodiscard]] std::size_t num_bytes_read() const {
    return static_cast<std::size_t>(cursor_.position - bytes_.data());
  }

 private:
  // The parser's place in the text, and its line, counted from 1.
  struct TextPosition {
    const char* position = nullptr;
    std::uint64_t line = 1;
  };
  class CursorIterator;

  // True for an object that is an element of the root's list of features or geometries.
  [[nodiscard]] static bool is_item(std::size_t depth, const std::string& list) {
    return depth == 2 && (list == "features" || list == "geometries");
  }
  // Handles an element of such a list.
  void on_item(const std::string& list, const JsonTree& item, const ItemListener& listener);
  // Handles what is left of the root at the end.
  void on_root(const JsonTree& root, const ItemListener& listener);
  static void visit_geometry(const JsonTree& geometry, const JsonTree& feature,
                             const ItemListener& listener);
  static void visit_feature(const JsonTree& feature, const ItemListener& listener);

  std::string_view bytes_;
  TextPosition cursor_{};        // position of the parser
  std::uint64_t item_line_ = 0;  // line of the current feature or geometry, 0 between them
  std::string_view item_;        // "feature" or "geometry" within one
  std::uint64_t num_items_ = 0;
};

// Collects properties and ids of features, row by row, into columns; a column has a cell in every
// row.
class PropertyColumns {
 public:
  PropertyColumns(std::vector<Column>& columns, Column& ids) : columns_(columns), ids_(ids) {}

  // Adds the properties and the id of a feature as cells of a row, and new columns for new names.
  void add(const JsonTree& feature, std::size_t row);
  // Forgets the ids of the rows from `row` on: an id is that of one row only.
  void forget_ids(std::size_t row);
  // Gives all columns `num_rows` cells, and drops what is known of kinds where it says nothing new.
  void finish(std::size_t num_rows);

 private:
  static void pad(Column& column, std::size_t size) {
    column.ends.resize(size, column.text.size());
  }
  static void pad_kinds(Column& column, std::size_t size) { column.is_json.resize(size, true); }

  std::vector<Column>& columns_;
  Column& ids_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace rondel::io
