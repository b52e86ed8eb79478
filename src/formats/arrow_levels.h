// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads an array of Arrow level by level: lists of lists, and at last positions.
//
// in    a schema and an array of the C data interface, which the caller keeps
// out   offsets of lists that begin with 0, and positions in longitude and latitude
// index elements of a level, from the first one that the level above has
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/arrow.h"
#include "rondel/types.h"

namespace rondel::formats {

// Throws InvalidInput: "the array of Arrow " and the text.
[[noreturn]] void refuse_arrow(const std::string& what);

// Returns the type of GeoArrow that the metadata of a field name, such as "geoarrow.point". Throws
// InvalidInput if there is none, or if its coordinates are no longitudes and latitudes.
std::string_view geoarrow_type(const ArrowSchema& schema);

// Reads the levels of an array one after the other. Each may begin at an offset of its own.
class ArrowLevels {
 public:
  ArrowLevels(const ArrowSchema& schema, const ArrowArray& array);

  // Returns the number of elements of the level.
  [[nodiscard]] std::uint64_t size() const { return end_ - begin_; }
  // True if an element of the level is null.
  [[nodiscard]] bool is_null(std::uint64_t element) const;
  // Returns the offsets of the lists, and goes on to their elements.
  std::vector<std::uint64_t> next();
  // Returns the positions.
  [[nodiscard]] std::vector<LonLat> positions() const;

 private:
  void go_to_child(std::int64_t child);
  // Returns the doubles of a child, of which there must be so many.
  [[nodiscard]] const double* numbers(std::int64_t child, std::uint64_t size) const;

  const ArrowSchema* schema_;
  const ArrowArray* array_;
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
};

}  // namespace rondel::formats
