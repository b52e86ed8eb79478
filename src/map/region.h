// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions and lines of any shape in the plane of longitude and latitude: not convex, with holes, with poles
// inside. polygon.h has what is convex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::map {

// A polygon with holes, as GeoJSON has it (RFC 7946): the outer ring first, counterclockwise, the holes
// clockwise; each closed (the last position is the first).
struct PolygonWithHoles {
  std::vector<std::vector<LonLat>> rings;
};

using UnitVectors = std::span<const Point>;

// Whether rings tell that a region has the border of the rectangle inside, and the poles with it. Where they enclose no
// area but that of rounding, the region may be that sliver or all else: areas tell by chance.
enum class BorderKnowledge : std::uint8_t { is_known, seems_outside, seems_inside };

// Loops with the region to the left. Where nothing is known they are those of the sliver.
struct DrawnRegion {
  std::vector<std::vector<LonLat>> loops;
  BorderKnowledge border = BorderKnowledge::is_known;
};

DrawnRegion draw_region(std::span<const UnitVectors> rings, double tolerance);

// The border of the rectangle, counterclockwise.
std::vector<LonLat> border_loop();

// The region to the left of all of the rings, consecutive points of which (and the last and the first) are
// joined by the shorter arc of a great circle, as loops inside [-180, 180] x [-90, 90] that have it to the left: cut
// along the antimeridian, at a pole they reach the side lat = +-90. Without rings it is the whole sphere. Loops may
// cross each other and themselves, where rings are nearer to each other than lines are to arcs. Areas decide what
// draw_region() does not know.
// 1. Sides are within the tolerance (radians) of the arcs.
// 2. An arc gives the same positions, bit by bit, to the regions on both sides of it.
// Precondition: the rings are simple and meet at most in points.
std::vector<std::vector<LonLat>> region_loops(std::span<const UnitVectors> rings, double tolerance);

// The polygons of a region that shares its border with no other one that is drawn, as valid_regions() makes them.
// What is no wider than rounding is left out.
RONDEL_API std::vector<PolygonWithHoles> region_polygons(std::span<const UnitVectors> rings,
                                                         double tolerance);

// A line, cut at the antimeridian and at the poles: each part has two positions or more. A closed line, of
// three points or more, that meets neither is one part whose last position is the first.
RONDEL_API std::vector<std::vector<LonLat>> line_parts(UnitVectors line, bool is_closed,
                                                       double tolerance);

}  // namespace rondel::map
