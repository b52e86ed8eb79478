// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks in rational numbers and by brute force whether polygons of the plane are valid simple
// features.
#pragma once

#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {

using PlanarRing = std::vector<LonLat>;           // closed: the last position is the first
using PlanarPolygon = std::vector<PlanarRing>;    // the outer ring and the holes
using PlanarRegion = std::vector<PlanarPolygon>;  // a MultiPolygon

// Empty if they are, otherwise what is wrong, and where:
// 1. a ring has four positions or more, is closed, and no two of its sides meet but neighbors in
//    their common end;
// 2. outer rings are counterclockwise, holes clockwise;
// 3. sides of two rings meet in single positions only, and do not cross;
// 4. holes lie in their outer ring and in no other hole, polygons do not overlap;
// 5. the inside of a polygon is connected: rings and the positions where they touch form no circle.
// Time: n^2.
std::string why_invalid(const PlanarRegion& region);

}  // namespace rondel::test
