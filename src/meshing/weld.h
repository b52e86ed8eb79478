// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Welds features that touch up to rounding. Where a corner of one should be on a side of another one,
// rounded numbers leave a gap, or an overlap, of some units in the last decimal. A refinement would
// fill it with triangles that are as small.
//
// in    lines, points and polygons, and how near is too near at each place
// out   the same, without places that are too near to another one, and with lines and rings that run
//       through the places that are too near to them
// index features; sites are their places, each once
#pragma once

#include <functional>

#include "rondel/geometries.h"
#include "rondel/types.h"

namespace rondel::meshing {

// `near_at` returns a distance on the unit sphere. Places that stay keep their coordinates. A ring of
// which no three corners are left vanishes, and a line of which one is left becomes a point.
// Precondition: no polygon is the whole sphere.
void weld(Geometries& features, const std::function<double(const Point&)>& near_at);

}  // namespace rondel::meshing
