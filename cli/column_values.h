// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Columns of numbers: one that an option names, and one that is computed.
///
/// in    a table of sites whose columns were kept (ReadOptions::keep_columns), or a netCDF file
/// out   doubles; a column of text
/// index sites, in the order of the file
#pragma once

#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::cli {

/// Returns the numbers of a column that was kept as text, one for each site; NaN if the cell is
/// empty, "nan", "NA" or "null". For a netCDF file, `name` may also be one of several fields of a
/// variable, "NAME[3]", as FieldFile takes it.
/// \throws UsageError, which begins with the option, if the table has no such column, or `name`
/// means several fields; FileError with the place of the first cell that is not a finite number.
std::vector<double> column_values(const SiteTable& table, const std::string& name,
                                  const std::string& option);

/// True if column_values() can read the column: every cell is a finite number or missing, and at
/// least one is a number or all are empty.
bool holds_numbers(const Column& column);

/// Returns values as a column of text, in the shortest digits that read back as the same doubles;
/// NaN is an empty cell.
Column numeric_column(const std::string& name, const std::vector<double>& values);

}  // namespace rondel::cli
