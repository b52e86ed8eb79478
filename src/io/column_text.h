// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The columns that are kept as text.
#pragma once

#include <string_view>

#include "rondel/io.h"

namespace rondel::io {

// An empty column; numeric until a cell says otherwise. Throws BadValue if the name is not UTF-8.
Column make_column(std::string_view name);

// Appends a cell. Throws BadValue if it is not UTF-8: what is kept goes into JSON.
void append_cell(Column& column, std::string_view cell);

}  // namespace rondel::io
