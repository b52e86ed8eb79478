// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How a table of sites is read.
#pragma once

#include <CLI/CLI.hpp>

#include "command.h"

namespace rondel::cli {

/// --delimiter, --radius, --lon, --lat, --x, --y, --z and --radians, as add_input_options() has them: for a table that is not INPUT.
void add_table_options(CLI::App& command, CommonOptions& options);

}  // namespace rondel::cli
