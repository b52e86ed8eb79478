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

/// Makes the page. \pre the columns of values and contours were kept
ExitStatus run_page(const PlotOptions& options);

}  // namespace rondel::cli
