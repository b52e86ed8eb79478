// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangles in the plane of longitude and latitude, in which models compute: three nodes of one
// meridian or parallel have no area there, whatever their triangle has on the sphere.
//
// in    positions in degrees, as files have them
// out   the exact sign of an area
// index nodes of the positions
#pragma once

#include <span>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::meshing {

// Returns the sign of the area to the left of a, b, c in degrees. Longitudes are taken in the turn
// around that of `a`; where that adds turns to them, numbers are rounded, and else the sign is exact.
// It is positive for a triangle with a corner at a pole or a pole inside, which the plane does not
// show.
Sign sign_in_degrees(const LonLat& a, const LonLat& b, const LonLat& c);

// Returns the number of triangles that are clockwise in degrees, though they are counterclockwise on the
// sphere: long ones beside a parallel, near poles. Throws InvalidInput (the position of the triangle) that
// says where if one has no area in degrees.
std::size_t require_area_in_degrees(std::span<const LonLat> positions,
                                    std::span<const Triple> triangles);

}  // namespace rondel::meshing
