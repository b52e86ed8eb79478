// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Pages of `rondel plot`.
#pragma once

#include "plot_options.h"

namespace rondel::cli {

/// Makes the page. \pre values and contours have their columns.
ExitStatus run_page(const PlotOptions& options);

}  // namespace rondel::cli
