// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws regions and lines of any shape in the plane of longitude and latitude: not convex, with
// holes, with poles inside. (polygon.h draws convex regions.)
//
// in    rings or lines of unit vectors, a tolerance in radians
// out   loops, polygons and lines in degrees
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

// A polygon with holes, as in GeoJSON (RFC 7946): the outer ring first, counterclockwise, then the
// holes, clockwise. Each ring is closed: its last position is the first one.
struct PolygonWithHoles {
  std::vector<std::vector<LonLat>> rings;
};

using UnitVectors = std::span<const Point>;

// Says whether the rings of a region decide that the border of the rectangle, and with it the
// poles, is inside of the region. If they enclose no more area than rounding, the region may be a
// sliver or all but that sliver; the computed areas then only suggest an answer.
enum class BorderKnowledge : std::uint8_t { is_known, seems_outside, seems_inside };

// Loops with the region to the left. If `border` is not known, they are the loops of the sliver.
struct DrawnRegion {
  std::vector<std::vector<LonLat>> loops;
  BorderKnowledge border = BorderKnowledge::is_known;
};

// Draws the region to the left of all rings. `tolerance` is in radians.
DrawnRegion draw_region(std::span<const UnitVectors> rings, double tolerance);

// Returns the border of the rectangle [-180, 180] x [-90, 90], counterclockwise.
std::vector<LonLat> border_loop();

// Returns the region to the left of all rings as loops that have it to their left. Consecutive
// points of a ring (and the last and the first) are joined by the shorter arc of a great circle.
// The loops are inside [-180, 180] x [-90, 90]: they are cut along the antimeridian, and at a pole
// they reach the side lat = +-90. Without rings the region is the whole sphere. Loops may cross
// each other and themselves where rings are nearer to each other than lines to arcs. Where
// draw_region() does not know the border, computed areas decide.
//
// 1. Sides are within the tolerance (radians) of the arcs.
// 2. An arc gives the same positions, bit by bit, to the regions on both sides of it.
//
// Precondition: the rings are simple, and two rings meet at most in points.
std::vector<std::vector<LonLat>> region_loops(std::span<const UnitVectors> rings, double tolerance);

// Returns the polygons of a region that shares its border with no other drawn region, as
// valid_regions() does. Parts that are no wider than rounding are dropped. `tolerance` is in
// radians.
std::vector<PolygonWithHoles> region_polygons(std::span<const UnitVectors> rings, double tolerance);

// Returns the parts of a line that is cut at the antimeridian and at the poles; each part has at
// least two positions. A closed line (of three or more points) that meets neither is one part whose
// last position is the first one. `tolerance` is in radians.
std::vector<std::vector<LonLat>> line_parts(UnitVectors line, bool is_closed, double tolerance);

}  // namespace rondel::map
