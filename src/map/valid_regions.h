// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes regions valid in the plane, in the sense of OGC simple features, while they still fit
// together.
//
// Arcs that do not cross on the sphere may be drawn as lines that cross: where they are nearer to
// each other than lines are to arcs, or than rounding resolves. Each pair of such lines is mended
// in this order:
//
// 1. A corner on a line divides the line.
// 2. Each line gets the point of its arc opposite the corners of the other line, or that corner
//    itself if it is within `reach`: lines between opposite points are nearly parallel.
// 3. Lines farther from their arcs than `reach` are bisected on them.
// 4. Lines that still cross, because they are nearer than rounding, get the crossing as a corner.
//
// The part of the map that no region covers is treated like a region, as two regions may have a
// narrow gap between them. Each step changes a line for all regions that have it. Sides that then
// occur in both directions are removed, and so are parts narrower than rounding. The reach begins
// with merge_distance and grows if the steps do not end. If they have not ended after
// `max_mending_passes`, or make too many lines, the lines of all regions are rounded to a grid, and
// each face of the subdivision that they form is given to one region (settled_regions.h).
#pragma once

#include <vector>

#include "map/planar_loops.h"
#include "map/region.h"
#include "rondel/types.h"

namespace rondel::map {

using LoopsOfRegion = std::vector<Loop>;  // the region is to the left of each
using PolygonsOfRegion = std::vector<PolygonWithHoles>;

// Returns the polygons of regions, given as loops with the region to the left.
//
// 1. Rings are simple, meet only in positions that both have, and lie inside of their outer rings;
//    the inside of a polygon is connected, and the polygons of a region do not overlap. This is
//    exact for the doubles returned.
// 2. Lines that two regions have in common stay common, bit by bit.
// 3. The result depends on the loops and their order, not on the number of threads.
//
// A region that is no wider than rounding gets no polygons. `may_overlap` says that regions may
// overlap although their lines do not cross, because draw_region() did not know the border of one.
std::vector<PolygonsOfRegion> valid_regions(std::vector<LoopsOfRegion> regions, unsigned threads,
                                            bool may_overlap = false);

}  // namespace rondel::map
