// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lines that come back to one of their points fall apart there.
#pragma once

#include <span>

#include "interpolation/contour_tracing.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// Appends the line as lines that visit no point twice: loops between two visits of a point, which are
// closed, and what is left. A loop of two points, which runs to and fro, is none; nor is a line of one.
void append_simple_lines(std::span<const Point> line, bool is_closed, TracedLines& out);

}  // namespace rondel::interpolation
