// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Writes columns as properties of features.
//
// in    columns of text, with the kinds of their cells
// out   text in JSON
// index rows of a column
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::io {

// Returns `,"name":` for each column, with the names of free_names().
std::vector<std::string> property_keys(std::span<const Column> columns,
                                       std::set<std::string> taken);

// Appends the cell of a row as JSON.
void append_value(std::string& out, const Column& column, std::size_t row);

// Appends `"id":ID,` where the row has an id.
void append_id(std::string& out, const Column& ids, std::size_t row);

}  // namespace rondel::io
