// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws convex regions of the sphere as polygons in longitude and latitude, as GeoJSON (RFC 7946)
// has them.
//
// in    rings of unit vectors, counterclockwise, tolerances in degrees
// out   polygons in degrees
#pragma once

#include <span>
#include <vector>

#include "map/trace.h"
#include "rondel/types.h"

namespace rondel::map {

struct LonLatPolygon {
  std::vector<LonLat> ring;  // degrees; closed (the last position is the first), counterclockwise
};

// Returns the polygons of the region to the left of a ring of unit vectors, in which consecutive
// points (and the last and the first) are joined by the shorter arc of a great circle.
//
// 1. They are simple polygons inside [-180, 180] x [-90, 90], cut along the antimeridian; at a pole
//    they reach the side lat = +-90.
// 2. A side is within tolerances_deg[i] of arc i, which begins at ring[i]; the distance is measured
//    in degrees on the sphere. Sides along the antimeridian and at the poles are exact.
// 3. An arc gives the same positions, bit by bit, to the regions on both sides of it.
// 4. An empty ring is the whole sphere. A ring with fewer than three distinct points has no
//    polygon; all points within merge_distance of a pole count as one.
//
// Precondition: the region is spherically convex, at most a hemisphere (except for an empty ring),
// and its boundary is simple. The boundary stays simple in the plane if the tolerance is small
// compared with the region's width.
std::vector<LonLatPolygon> lonlat_polygons(std::span<const Point> ring,
                                           std::span<const double> tolerances_deg);

// Returns the same region as drawn_loops() does: loops with the region to the left.
std::vector<std::vector<LonLat>> lonlat_loops(std::span<const Point> ring,
                                              std::span<const double> tolerances_deg);

// Returns the loops of a drawn ring, with the region to the left, unchanged: they may cross, or go
// back on themselves. A clockwise loop around the rectangle means that nearly all of the rectangle
// is outside.
std::vector<std::vector<LonLat>> drawn_loops(const Trace& trace);

// Returns the polygons that a drawn ring bounds.
std::vector<LonLatPolygon> polygons_of(const Trace& trace);

// True if a loop is its own polygon: it has 3 to longest_plain positions, all different, crosses
// itself nowhere and is counterclockwise.
bool is_plain_loop(std::span<const LonLat> loop);
inline constexpr std::size_t longest_plain = 32;

// True if a drawn ring that does not cross itself has its region to the right: the lines of
// opposite sides have passed each other from end to end.
bool is_turned_over(const Trace& trace);

}  // namespace rondel::map
