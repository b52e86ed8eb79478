// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Draws pictures of `rondel plot` (.png .svg .pdf).
///
/// in    the options of `rondel plot`, whose INPUT is read here
/// out   a file with the picture
#pragma once

#include "plot_draw.h"
#include "plot_options.h"

namespace rondel::cli {

/// Reads and triangulates INPUT, and draws the picture to OUTPUT. It is compiled where Cairo is.
/// \pre OUTPUT and the options were checked. \throws FileError
ExitStatus run_picture(const PlotOptions& options, FigureFormat format);

}  // namespace rondel::cli
