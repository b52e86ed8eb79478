// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The columns that are kept as text, and tables of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/io.h"

namespace rondel::io {

// An empty column; numeric until a cell says otherwise. Throws BadValue if the name is not UTF-8.
Column make_column(std::string_view name);

// Appends a cell. Throws BadValue if it is not UTF-8: what is kept goes into JSON.
void append_cell(Column& column, std::string_view cell);

// Appends a field of a table, in quotes where it needs them.
RONDEL_API void append_csv_field(std::string& text, std::string_view field, char separator);

// The cell of a row.
RONDEL_API std::string_view cell_of(const Column& column, std::size_t row);

// A table with a header and a line for each of the rows; no text if there are no columns.
RONDEL_API std::string csv_of(std::span<const Column> columns);

// The columns of such a table. Throws BadValue if the text is no table, or has not this number of rows.
RONDEL_API std::vector<Column> columns_of_csv(std::string_view text, std::size_t num_rows);

}  // namespace rondel::io
