// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks from first principles what RFC 7946 and the sphere demand of polygons in longitude and
// latitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "map/polygon.h"

namespace rondel::test {

using Ring = std::vector<LonLat>;

inline double turn(const LonLat& a, const LonLat& b, const LonLat& c) {
  return (b.lon_deg - a.lon_deg) * (c.lat_deg - a.lat_deg) -
         (b.lat_deg - a.lat_deg) * (c.lon_deg - a.lon_deg);
}

inline double planar_area(const Ring& ring) {
  double doubled = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    doubled += turn(ring.front(), ring[i], ring[i + 1]);
  }
  return doubled / 2;
}

// The area on the sphere inside straight sides in the plane: -sin(lat) d lon around the ring, with
// latitudes relative to the first so that tiny rings lose nothing.
inline double spherical_area(const Ring& ring) {
  constexpr double radians = std::numbers::pi / 180;
  double area = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const double middle = (ring[i].lat_deg + ring[i + 1].lat_deg) / 2;
    const double half = (ring[i + 1].lat_deg - ring[i].lat_deg) / 2 * radians;
    const double sinc_less_1 = std::abs(half) < 1e-3 ? half * half * (half * half / 120 - 1.0 / 6)
                                                     : std::sin(half) / half - 1;
    const double first = ring[0].lat_deg;
    const double rise =
        2 * std::cos((middle + first) / 2 * radians) * std::sin((middle - first) / 2 * radians);
    area -= (ring[i + 1].lon_deg - ring[i].lon_deg) * radians *
            (rise + std::sin(middle * radians) * sinc_less_1);
  }
  return area;
}

inline bool contains(const Ring& ring, const LonLat& p) {
  bool inside = false;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const LonLat& a = ring[i];
    const LonLat& b = ring[i + 1];
    if ((a.lat_deg > p.lat_deg) == (b.lat_deg > p.lat_deg)) continue;
    if ((turn(a, b, p) > 0) == (b.lat_deg > a.lat_deg)) inside = !inside;
  }
  return inside;
}

inline bool contains(const std::vector<map::LonLatPolygon>& polygons, const LonLat& p) {
  return std::ranges::any_of(polygons,
                             [&](const auto& polygon) { return contains(polygon.ring, p); });
}

inline bool sides_meet(const Ring& r, std::size_t i, std::size_t j) {
  return turn(r[i], r[i + 1], r[j]) * turn(r[i], r[i + 1], r[j + 1]) <= 0 &&
         turn(r[j], r[j + 1], r[i]) * turn(r[j], r[j + 1], r[i + 1]) <= 0 &&
         std::max(std::min(r[i].lon_deg, r[i + 1].lon_deg),
                  std::min(r[j].lon_deg, r[j + 1].lon_deg)) <=
             std::min(std::max(r[i].lon_deg, r[i + 1].lon_deg),
                      std::max(r[j].lon_deg, r[j + 1].lon_deg)) &&
         std::max(std::min(r[i].lat_deg, r[i + 1].lat_deg),
                  std::min(r[j].lat_deg, r[j + 1].lat_deg)) <=
             std::min(std::max(r[i].lat_deg, r[i + 1].lat_deg),
                      std::max(r[j].lat_deg, r[j + 1].lat_deg));
}

// Empty if the ring is closed, counterclockwise, simple and inside the rectangle; else what is not.
inline std::string fault(const Ring& ring) {
  if (ring.size() < 4 || ring.front() != ring.back()) return "not closed";
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    if (!(std::abs(ring[i].lon_deg) <= 180 && std::abs(ring[i].lat_deg) <= 90)) return "outside";
    if (ring[i] == ring[i + 1]) return "repeated position";
    if (std::signbit(ring[i].lon_deg) && ring[i].lon_deg == 0) return "negative zero";
  }
  if (planar_area(ring) <= 0) return "clockwise";
  const std::size_t n = ring.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (sides_meet(ring, i, j))
        return "sides " + std::to_string(i) + " and " + std::to_string(j) + " meet";
    }
  }
  return "";
}

inline std::string fault(const std::vector<map::LonLatPolygon>& polygons) {
  for (const auto& polygon : polygons) {
    if (const std::string what = fault(polygon.ring); !what.empty()) return what;
  }
  return "";
}

inline double spherical_area(const std::vector<map::LonLatPolygon>& polygons) {
  double area = 0;
  for (const auto& polygon : polygons) area += spherical_area(polygon.ring);
  return area;
}

inline double planar_area(const std::vector<map::LonLatPolygon>& polygons) {
  double area = 0;
  for (const auto& polygon : polygons) area += planar_area(polygon.ring);
  return area;
}

}  // namespace rondel::test
