// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regions of the sphere as polygons in longitude and latitude, as GeoJSON (RFC 7946) wants them.
#pragma once

#include <span>
#include <vector>

#include "map/trace.h"
#include "rondel/types.h"

namespace rondel::map {

struct LonLatPolygon {
  std::vector<LonLat> ring;  // degrees; closed (the last position is the first), counterclockwise
};

// The region to the left of a ring of unit vectors, consecutive ones (and the last and
// the first) joined by the shorter arc of a great circle.
// 1. Simple polygons inside [-180, 180] x [-90, 90], cut along the antimeridian; at a pole they
//    reach the side lat = +-90.
// 2. Their sides are within the arc's tolerance (degrees, measured on the sphere) of it. Sides along the antimeridian and the poles are exact.
// 3. An arc gives the same positions, bit by bit, to the regions on both sides of it.
// 4. An empty ring is the whole sphere. A ring with one or two distinct points, those within
//    merge_distance of a pole taken as one, has no polygon.
// Precondition: the region is spherically convex, at most a hemisphere (an empty ring apart), and
// its boundary is simple; it stays so in the plane if the tolerance is small
// compared with its width.
std::vector<LonLatPolygon> lonlat_polygons(std::span<const Point> ring,
                                           std::span<const double> tolerances_deg);

// The same as loops with the region to the left, as drawn_loops() has them.
std::vector<std::vector<LonLat>> lonlat_loops(std::span<const Point> ring,
                                              std::span<const double> tolerances_deg);

// The loops of a drawn ring, with the region to the left, as they are: they may cross, or run to and fro. A loop around the
// rectangle, clockwise, makes the outside of nearly all of it.
std::vector<std::vector<LonLat>> drawn_loops(const Trace& trace);

// The polygons that a drawn ring bounds.
std::vector<LonLatPolygon> polygons_of(const Trace& trace);

// Whether the polygon of a closed loop of these positions is they themselves: 3 to longest_plain, no
// two of them equal, and counterclockwise.
bool is_plain_loop(std::span<const LonLat> loop);
inline constexpr std::size_t longest_plain = 32;

// Whether the drawn ring, which does not cross itself, has its region to the right: the lines of
// opposite sides have passed each other from end to end.
bool is_turned_over(const Trace& trace);

}  // namespace rondel::map
