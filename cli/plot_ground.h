// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What lies on the globe before a triangulation does: coasts, meridians and parallels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "globe.h"
#include "plot_canvas.h"
#include "rondel/types.h"

namespace rondel::cli {

/// Lines of arcs in the view frame: line k is `points[offsets[k]] ... points[offsets[k+1]-1]`.
struct LineLayer {
  std::vector<Point> points;
  std::vector<std::uint64_t> offsets = {0};
};

/// Lines of longitude and latitude, such as rondel::coast_lines(), as they are seen.
LineLayer seen(std::span<const LonLat> positions, std::span<const std::uint64_t> offsets,
               const View& view);

/// The parts of the coasts that are in front, as thin lines.
void draw_coast(Canvas& canvas, const LineLayer& coast, int size);

/// Meridians and parallels, `step` degrees apart; 0: none.
void draw_graticule(Canvas& canvas, const View& view, int step, int size);

}  // namespace rondel::cli
