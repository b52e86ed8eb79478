// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Longitudes and latitudes in degrees to unit vectors, and back. Sines, cosines and angles are
// computed by exact/angles.h, so the bits are the same on every machine.

#include <cmath>
#include <limits>
#include <string>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel {

// Nothing is validated here. Adding 0 turns -0 into 0, so that equal places have equal bits.
Point unit_vector(const LonLat& position) {
  const system::ArithmeticScope arithmetic;
  return system::apart([&] {
    const auto lon = exact::sine_cosine_of_degrees(position.lon_deg);
    const auto lat = exact::sine_cosine_of_degrees(position.lat_deg);
    return Point{lat.cosine * lon.cosine + 0.0, lat.cosine * lon.sine + 0.0, lat.sine};
  });
}

// Throws InvalidInput for the first place that is none: an infinite longitude, or a latitude beyond
// 90 degrees or NaN.
std::vector<Point> unit_vectors(std::span<const LonLat> positions) {
  const system::ArithmeticScope arithmetic;
  std::vector<Point> result(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const LonLat& p = positions[i];
    if (!std::isfinite(p.lon_deg) || !(std::abs(p.lat_deg) <= 90)) {
      const std::string what =
          std::isfinite(p.lon_deg)
              ? "latitude " + system::shortest_text(p.lat_deg) + " is outside [-90, 90]"
              : "longitude is not finite";
      throw InvalidInput("site " + std::to_string(i) + ": " + what, i);
    }
    result[i] = unit_vector(p);
  }
  return result;
}

// A point may have any length. The origin, and a point that is not finite, has no place: NaN. At
// the poles the longitude is 0.
std::vector<LonLat> lonlats(std::span<const Point> points) {
  const system::ArithmeticScope arithmetic;
  std::vector<LonLat> result;
  result.reserve(points.size());
  for (const Point& point : points) {
    // Scaling by the largest coordinate comes first, so that no square overflows or underflows.
    const Point u = normalized(scaled(point));
    if (!(norm(u) > 0)) {  // no ray goes through the origin, or a coordinate is not finite
      constexpr double no_place = std::numeric_limits<double>::quiet_NaN();
      result.push_back({no_place, no_place});
    } else if (exact::is_pole(u)) {
      result.push_back({0, std::copysign(90.0, u.z)});
    } else {
      result.push_back(exact::lonlat_of(u, true));
    }
  }
  return result;
}

}  // namespace rondel
