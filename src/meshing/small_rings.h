// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Leaves out the islands and lakes of a domain that are nowhere wider than the tolerance, before it is
// simplified.
//
// in    polygons
// out   the same with fewer rings
#pragma once

#include "rondel/cell_rings.h"
#include "rondel/simplify.h"

namespace rondel::meshing {

// Leaves out the rings that are nowhere wider than the tolerance, and those within them: rings along an
// arc, of which no corner is farther from it, and rings that vanish when they are simplified alone, without
// a clearance. So nothing that a ring touches or crosses keeps it. A polygon that is left without rings and
// had what is outside of them becomes the whole sphere.
CellRings without_small_rings(const CellRings& polygons, const SimplifyOptions& options);

}  // namespace rondel::meshing
