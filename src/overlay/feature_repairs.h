// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repairs polygons that are not valid.
//
// in    rings of features as a file has them
// out   one cell for a feature: the union of its polygons, each read by the even-odd rule
// index the sides of a feature: those of all of its rings, one ring after the other
//
// Sides that are straight in longitude and latitude become arcs as those of valid polygons do, and
// the arrangement of these arcs has the crossings. Sides of more than 180 degrees of longitude go
// the shorter way around the globe. A pole says what is inside: no side is beyond it, so
// that it is outside, unless sides lead along it or an odd number of rings goes around it. The
// outside of geodesic rings is opposite to their middle; where they are in no hemisphere, a ring is
// around its smaller side.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "map/polygon_features.h"
#include "overlay/plane_sweep.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// True if a ring goes around the globe, or has a side of more than 180 degrees of longitude that is
// neither at a pole nor between two meridians, as those of a box are: its sides go the shorter way
// around the globe.
bool goes_shorter_way(const map::LonLatRing& ring);

// Returns the sides of all rings. Where they go the shorter way around the globe, a side may end a
// turn away from where the next one begins.
std::vector<PlaneSide> given_sides(std::span<const map::LonLatRing> rings);

// Returns the cell of a feature. `corners` has a row for each of the given sides: the arcs between
// its ends, with unit vectors to the first one and those between. Throws InvalidInput if the ends
// of an arc are opposite to each other.
CellRings repaired_plane_feature(std::span<const map::LonLatRing> rings,
                                 std::span<const std::span<const LonLat>> corners,
                                 const Execution& execution);

// Returns the cell of a feature whose sides are geodesic. Throws InvalidInput as above.
CellRings repaired_geodesic_feature(std::span<const map::LonLatRing> rings,
                                    const Execution& execution);

}  // namespace rondel::overlay
