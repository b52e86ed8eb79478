// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Writes pages of `rondel plot` (.html).
///
/// in    the options of `rondel plot`, whose INPUT is read here
/// out   one file of HTML with all data and programs in it
#pragma once

#include "plot_options.h"

namespace rondel::cli {

/// Reads and triangulates INPUT, and writes the page to OUTPUT. \pre OUTPUT and the options were
/// checked. \throws UsageError for an option that only pictures have, FileError
ExitStatus run_page(const PlotOptions& options);

}  // namespace rondel::cli
