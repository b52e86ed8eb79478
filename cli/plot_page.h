// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What `rondel plot` needs to make a page.
#pragma once

#include <string>
#include <vector>

#include "rondel/io.h"

namespace rondel::cli {

/// The numbers of a column that was kept, one of each site; an empty cell is not a number.
/// \throws UsageError if the table has no such column or there are other cells than numbers.
std::vector<double> column_values(const SiteTable& table, const std::string& name);

/// "stations" of "data/stations.csv"; "Sites" of standard input.
std::string title_of(const std::string& input);

}  // namespace rondel::cli
