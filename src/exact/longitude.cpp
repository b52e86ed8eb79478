// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "exact/longitude.h"

#include <algorithm>
#include <cmath>

#include "exact/argument.h"

namespace rondel::exact {
namespace {

// Replaces degrees nearer to zero than any rounding by zero: programs that read the numbers
// multiply them, and products of tiny numbers underflow. Adding zero turns -0 into 0.
double without_tiny(double degrees) {
  constexpr double tiny = 0x1p-64;
  return std::abs(degrees) < tiny ? 0 : degrees + 0.0;
}

}  // namespace

LonLat lonlat_of(const Point& p, bool east) {
  double lon = argument(p.y, p.x) * degrees_per_radian;
  if (p.y == 0) lon = p.x > 0 ? 0 : (east ? 180 : -180);
  const double lat = argument(p.z, distance_from_axis(p)) * degrees_per_radian;
  return {without_tiny(std::clamp(lon, -180.0, 180.0)), without_tiny(std::clamp(lat, -90.0, 90.0))};
}

}  // namespace rondel::exact
