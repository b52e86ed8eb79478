// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Draws what lies on the globe below a triangulation: coasts, meridians and parallels.
///
/// in    lines of longitudes and latitudes in degrees
/// out   thin lines on the canvas, where they are in front
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "globe.h"
#include "plot_canvas.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::cli {

/// Lines of arcs in the view frame.
using LineLayer = CompressedRows<Point>;

/// Returns lines of positions in degrees, such as rondel::coast_lines(), in the view frame.
LineLayer seen(const CompressedRows<LonLat>& lines, const View& view);

/// The parts of the coasts that are in front, as thin lines.
void draw_coast(Canvas& canvas, const LineLayer& coast, int size);

/// Draws meridians and parallels, `step` degrees apart; 0: none.
void draw_graticule(Canvas& canvas, const View& view, int step, int size);

}  // namespace rondel::cli
