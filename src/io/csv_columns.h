// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the columns of a table that hold the coordinates.
//
// in    the header of a table, and the names that the user gave
// out   positions of columns, from 0 on
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/io.h"

namespace rondel::io {

// The columns of the coordinates.
struct CoordinateColumns {
  bool is_lonlat = false;                // true: lon, lat; false: x, y, z
  std::array<std::size_t, 3> columns{};  // lon, lat or x, y, z
  std::optional<std::size_t> radius;     // only if the options name it
};

// True if the options name columns of coordinates, or the header has those of all coordinates.
bool has_coordinates(const std::vector<std::string>& header, const ReadOptions& options);

// Gives an underscore to the names of columns, behind `lon` and `lat` in a table that is written, which
// would be taken for coordinates when it is read: those of longitudes and latitudes in any case of
// letters, and `x`, `y` and `z` if all three are there.
void distinguish_from_coordinates(std::span<std::string> names);

// Finds the columns that the options name, or otherwise those with usual names; the order of
// columns never decides. A radius must be named, since a column of that name may be anything. Names
// are compared without regard to case. Throws BadValue if a column is missing or two match.
CoordinateColumns find_columns(const std::vector<std::string>& header, const ReadOptions& options);

// Returns the names of the columns without blanks around them. A column without a name, as pandas'
// to_csv() and R's write.csv() write their index, gets its position as a name, counted from 1:
// "column_1".
std::vector<std::string> column_names(const std::vector<std::string_view>& header);

// Returns the column of exactly this name, or nothing. Throws BadValue with both positions if two
// have it.
std::optional<std::size_t> find_column(const std::vector<std::string>& names,
                                       std::string_view name);

// Throws BadValue if two columns have the same name.
void require_different_names(const std::vector<std::string>& names);

// True if other programs treat a record that begins with this field as a comment.
bool is_comment(std::string_view first_field);

}  // namespace rondel::io
