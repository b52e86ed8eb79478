// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which columns of a table hold the coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"

namespace rondel::io {

struct CoordinateColumns {
  bool is_lonlat = false;
  std::array<std::size_t, 3> columns{};  // lon, lat or x, y, z
  std::optional<std::size_t> radius;     // if the options name it
};

// Finds the columns that the options name, otherwise by their usual names; never by their order. A
// radius must be named: a column of that name may be anything.
// Names are compared without regard to case. Throws BadValue if a column is missing or two fit.
CoordinateColumns find_columns(const std::vector<std::string>& header, const ReadOptions& options);

// The names of the columns, without blanks around them. A column without a name, as pandas' to_csv() and
// R's write.csv() make one of their index, has its position as a name, from 1 on: "column_1".
RONDEL_API std::vector<std::string> column_names(const std::vector<std::string_view>& header);

// The column of exactly this name. Throws BadValue with both positions if two have it.
RONDEL_API std::optional<std::size_t> find_column(const std::vector<std::string>& names,
                                                  std::string_view name);

// Throws BadValue if two columns have the same name.
RONDEL_API void require_different_names(const std::vector<std::string>& names);

// Whether a record that begins with this field is a comment in other programs.
bool is_comment(std::string_view first_field);

}  // namespace rondel::io
