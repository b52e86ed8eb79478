// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <string>

#include "exact/degrees.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/arithmetic.h"
#include "system/shortest_text.h"

namespace rondel {

Point unit_vector(const LonLat& position) {
  const system::ArithmeticScope arithmetic;
  return system::apart([&] {
    const auto lon = exact::sine_cosine_of_degrees(position.lon_deg);
    const auto lat = exact::sine_cosine_of_degrees(position.lat_deg);
    return Point{lat.cosine * lon.cosine + 0.0, lat.cosine * lon.sine + 0.0, lat.sine};
  });
}

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

}  // namespace rondel
