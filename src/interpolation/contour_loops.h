// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Splits lines that visit a point twice.
//
// in    a line as a sequence of points, closed or not
// out   lines that visit no point twice
// index points of the line, in its order
#pragma once

#include <span>

#include "interpolation/contour_tracing.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// Appends the line as lines that visit no point twice: each part between two visits of a point
// becomes a closed line of its own, and what remains is the last line. Loops of fewer than three
// points and lines of fewer than two points are dropped.
void append_simple_lines(std::span<const Point> line, bool is_closed, TracedLines& out);

}  // namespace rondel::interpolation
