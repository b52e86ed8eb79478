// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Longitudes and latitudes of directions, the same bits on every platform.
#pragma once

#include <cmath>
#include <numbers>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::exact {

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

inline bool is_pole(const Point& p) { return p.x == 0 && p.y == 0; }

// Returns the distance from the line through the poles.
inline double distance_from_axis(const Point& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

// Returns the longitude and latitude of a unit vector that is not a pole. A point on the
// antimeridian has two longitudes: it gets 180 if `east` is true, and -180 otherwise.
RONDEL_API LonLat lonlat_of(const Point& p, bool east);

}  // namespace rondel::exact
