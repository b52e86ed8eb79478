// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whether a drawn ring crosses itself in the plane, though it does not on the sphere.
#pragma once

#include <cstddef>
#include <vector>

#include "io/lonlat_trace.h"

namespace rondel::io {

// The lines of a trace, named by their first points, that meet another line of it that is not next
// to them. Two nearly parallel arcs that end in a sharp tip do so when they are densified
// at different places.
std::vector<std::size_t> crossing_lines(const Trace& trace);

}  // namespace rondel::io
