// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Columns that are kept as text, and tables of them as CSV.
//
// in    cells of tables, in UTF-8
// out   columns; or the text of a table
// index rows of a column
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/io.h"

namespace rondel::io {

// Returns an empty column, which is numeric until a cell is no number. Throws BadValue if the name
// is not UTF-8.
Column make_column(std::string_view name);

// Appends a cell. Throws BadValue if it is not UTF-8, since columns are written as JSON.
void append_cell(Column& column, std::string_view cell);

// True if the text is an integer that is no double.
bool is_wide_integer(std::string_view text);

// Appends a field of a table, in quotes if it needs them.
void append_csv_field(std::string& text, std::string_view field, char separator);

// Returns a table with a header and a line for each row; an empty text if there are no columns.
std::string csv_of(std::span<const Column> columns);

// Returns the columns of such a table. Throws BadValue if the text is no table or has another
// number of rows.
std::vector<Column> columns_of_csv(std::string_view text, std::size_t num_rows);

}  // namespace rondel::io
