// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Repairs polygons that are not valid.
//
// in    rings of features as a file has them
// out   one cell for a feature: the union of its polygons, each read by the even-odd rule
// index the sides of a feature: those of all of its rings, one ring after the other
//
// Sides that are straight in longitude and latitude become arcs as those of valid polygons do, and the
// arrangement of these arcs has the crossings. A pole says what is inside: no side is beyond it, so
// that it is outside, unless sides lead along it or an odd number of rings goes around it. Geodesic
// rings are around their smaller sides where they are simple; where they cross, the outside is
// opposite to them (rondel/set_operations.h).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "map/polygon_features.h"
#include "overlay/plane_sweep.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// True for a ring around a pole that straight lines do not lead to it.
bool is_around_pole(const map::LonLatRing& ring);

// Returns the sides of all rings. The sides of a ring around a pole go the shorter way around the
// globe, so that the last one does not end at the first position but a turn away from it.
std::vector<PlaneSide> given_sides(std::span<const map::LonLatRing> rings);

// Returns the cell of a feature. `corners` has a row for each of the given sides: the arcs between
// its ends, with unit vectors to the first one and those between. Throws InvalidInput if the ends of
// an arc are opposite to each other.
CellRings repaired_plane_feature(std::span<const map::LonLatRing> rings,
                                 std::span<const std::span<const LonLat>> corners,
                                 const Execution& execution);

// Returns the cell of a feature whose sides are geodesic. Throws InvalidInput as above.
CellRings repaired_geodesic_feature(std::span<const map::LonLatRing> rings,
                                    const Execution& execution);

}  // namespace rondel::overlay
