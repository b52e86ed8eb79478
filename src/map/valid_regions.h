// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions that are valid in the plane, as simple features have it, and still fit together.
//
// Arcs of the sphere that do not cross may have lines that do: where they are nearer to each other than lines are to
// arcs, or than rounding resolves. For each pair of such lines, in this order,
// 1. a corner on a line divides it;
// 2. each line gets the point of its arc opposite the corners of the other, or that corner itself where it is within
//    `reach` of it: lines between opposite points are as good as parallel;
// 3. lines farther from their arcs than `reach` are bisected on them;
// 4. what crosses then, as it is narrower than rounding, gets the crossing as a corner.
// What no region covers is treated like one, as two regions may be as near to each other with a narrow gap between them. Each
// step changes the line for all regions that have it. Sides in both directions go, and what is narrower than
// rounding goes with them. The reach grows from merge_distance, where steps do not end. Where they still have not ended after
// `most_passes`, or make too many lines, the lines of all regions are rounded to a grid and divide the plane, and each part of it is given to one
// region (settled_regions.h).
#pragma once

#include <vector>

#include "map/planar_loops.h"
#include "map/region.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::map {

using LoopsOfRegion = std::vector<Loop>;  // the region is to the left of each
using PolygonsOfRegion = std::vector<PolygonWithHoles>;

// 1. Rings are simple, meet in positions of both only, and lie in their outer rings; the inside of a polygon is
//    connected, and the polygons of a region do not overlap: exact for the doubles that they are.
// 2. Lines that two regions have in common stay common, bit by bit.
// 3. The result depends on the loops and their order, not on the number of threads.
// One has no polygons if it is no wider than rounding.
// `may_overlap` says that regions may overlap each other whose lines do not cross, as draw_region() did not know all.
RONDEL_API std::vector<PolygonsOfRegion> valid_regions(std::vector<LoopsOfRegion> regions,
                                                       unsigned threads, bool may_overlap = false);

}  // namespace rondel::map
