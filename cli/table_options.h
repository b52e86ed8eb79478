// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options that say how to read a table of sites.
///
/// in    the command line
/// out   ReadOptions and the model; usage errors for options that change nothing
#pragma once

#include <CLI/CLI.hpp>

#include "command.h"

namespace rondel::cli {

/// Adds --delimiter, --radius, --lon, --lat, --x, --y, --z and --radians like add_input_options(),
/// for a table that is not INPUT. They are usage errors if all of `tables` are netCDF or grids;
/// --radius is one if the first of them is.
void add_table_options(CLI::App& command, CommonOptions& options, const TablesRead& tables);

}  // namespace rondel::cli
