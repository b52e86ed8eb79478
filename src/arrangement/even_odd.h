// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The union of polygons whose rings may cross, with known places.
//
// in    polygons, and for each a place of which it is known whether it is inside
// out   one cell: the places that an odd number of rings of some polygon divides from its known
//       place, or an even number if that place is inside
// index polygons
#pragma once

#include <optional>
#include <span>

#include "arrangement/coverage.h"
#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Returns one cell, as unite() does. Rings may have any number of corners and either direction.
// Where no place is known, the direction of the rings says what is inside, as for unite().
CellRings even_odd_union(const CellRings& polygons,
                         std::span<const std::optional<KnownPlace>> known,
                         const Execution& execution);

}  // namespace rondel::arrangement
