// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Features whose arcs meet in corners alone. A simplification keeps the topology of such features;
// of others it keeps where an arc begins and ends, but not where it crosses another one: a coast
// that is almost along the border of the area may cross it far from where it did.
//
// in    lines and polygons
// out   the same, with corners where arcs cross, touch or overlap
// index features, as given
#pragma once

#include <cstddef>
#include <optional>

#include "rondel/geometries.h"
#include "rondel/types.h"

namespace rondel::meshing {

// Returns nothing if arcs meet in corners alone.
std::optional<Geometries> meeting_in_corners(const Geometries& all, const Execution& execution);

// False only if no two of the first polygons, up to before `end`, have a place in common, and none has a
// corner twice: the boxes around them do not overlap, and none is on the outside of its rings.
bool may_have_common_places(const CellRings& polygons, std::size_t end);

// Gives the polygons of the features from `begin` to before `end` to the first of these, as one.
void unite_polygons(std::size_t begin, std::size_t end, Geometries& all,
                    const Execution& execution);

}  // namespace rondel::meshing
