// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which columns of a table hold the coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

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
CoordinateColumns find_columns(const std::vector<std::string_view>& header,
                               const ReadOptions& options);

// Whether a record that begins with this field is a comment in other programs.
bool is_comment(std::string_view first_field);

}  // namespace rondel::io
