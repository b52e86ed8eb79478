// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// A column of numbers that an option names.
#pragma once

#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::cli {

/// The numbers of a column that was kept, one of each site; not a number where the cell is empty,
/// "nan", "NA" or "null". Of a netCDF file also one of several fields of a variable, by its place, as FieldFile takes it.
/// \throws UsageError, which begins with the option, if the table has no such column, or names one that is several; FileError with
/// the place of the first cell that is no finite number.
std::vector<double> column_values(const SiteTable& table, const std::string& name,
                                  const std::string& option);

}  // namespace rondel::cli
