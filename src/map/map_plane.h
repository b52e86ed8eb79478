// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Predicates in the plane of longitude and latitude, exact for positions given as doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::map {

// Orders positions by longitude, then by latitude.
struct InPlane {
  bool operator()(const LonLat& p, const LonLat& q) const {
    return p.lon_deg != q.lon_deg ? p.lon_deg < q.lon_deg : p.lat_deg < q.lat_deg;
  }
};

// Returns the distance |dlon| + |dlat| in degrees.
inline double distance_in_plane(const LonLat& p, const LonLat& q) {
  return std::abs(p.lon_deg - q.lon_deg) + std::abs(p.lat_deg - q.lat_deg);
}

// Returns which of some equal parts of the map's longitudes has this one; the first and the last part
// have what is beyond the map.
inline std::size_t part_of_longitudes(double lon_deg, std::size_t num_parts) {
  const double share = std::clamp((lon_deg + 180) / 360, 0.0, 1.0);
  const auto part = static_cast<std::size_t>(share * static_cast<double>(num_parts));
  return std::min(part, num_parts - 1);
}

// True if two positions are within 1e-6 degrees of each other, so that a line that ends at one of
// them may end at the other instead. Nearness on the sphere does not suffice: next to a pole, near
// points can have any longitudes, and the line would be elsewhere.
inline bool are_near_in_plane(const LonLat& p, const LonLat& q) {
  constexpr double most = 1e-6;
  return distance_in_plane(p, q) <= most;
}

// Returns positive if r is to the left of the line from p to q, exactly. The rounded determinant is
// off by at most (3 + 16 u) u times the sum of the sizes of its two products, u = 2^-53 (Shewchuk
// 1997, Orient2D), which 2^-51 exceeds. The smallest normal number covers products that underflow.
inline Sign side_of_line(const LonLat& p, const LonLat& q, const LonLat& r) {
  const double left = (q.lon_deg - p.lon_deg) * (r.lat_deg - p.lat_deg);
  const double right = (q.lat_deg - p.lat_deg) * (r.lon_deg - p.lon_deg);
  const double bound = 0x1p-51 * (std::abs(left) + std::abs(right)) + 0x1p-1022;
  if (left - right > bound) return Sign::positive;
  if (left - right < -bound) return Sign::negative;
  return orientation({p.lon_deg, p.lat_deg, 1}, {q.lon_deg, q.lat_deg, 1},
                     {r.lon_deg, r.lat_deg, 1});
}

// True if p lies in the closed rectangle around a line.
inline bool is_beside(const LonLat& a, const LonLat& b, const LonLat& p) {
  const auto [west, east] = std::minmax(a.lon_deg, b.lon_deg);
  const auto [south, north] = std::minmax(a.lat_deg, b.lat_deg);
  return west <= p.lon_deg && p.lon_deg <= east && south <= p.lat_deg && p.lat_deg <= north;
}

// True if p is on the line between a and b, and is neither a nor b; exact.
inline bool is_between(const LonLat& a, const LonLat& b, const LonLat& p) {
  return is_beside(a, b, p) && !(p == a) && !(p == b) && side_of_line(a, b, p) == Sign::zero;
}

// True if the lines ab and cd cross in a point inside of both; exact.
inline bool do_lines_cross(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  const Sign sign_c = side_of_line(a, b, c);
  const Sign sign_d = side_of_line(a, b, d);
  if (sign_c == sign_d || sign_c == Sign::zero || sign_d == Sign::zero) return false;
  const Sign sign_a = side_of_line(c, d, a);
  const Sign sign_b = side_of_line(c, d, b);
  return sign_a != sign_b && sign_a != Sign::zero && sign_b != Sign::zero;
}

// True if, counterclockwise around the position `at` and beginning in the east, x comes before y;
// exact.
inline bool is_before_around(const LonLat& at, const LonLat& x, const LonLat& y) {
  const auto is_low = [&](const LonLat& p) {
    return p.lat_deg < at.lat_deg || (p.lat_deg == at.lat_deg && p.lon_deg < at.lon_deg);
  };
  if (is_low(x) != is_low(y)) return is_low(y);
  return side_of_line(at, x, y) == Sign::positive;
}

// True if a loop turns back by 180 degrees somewhere, so that two consecutive sides overlap.
inline bool has_spike(std::span<const LonLat> loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const LonLat& p = loop[k];
    const LonLat& tip = loop[k + 1 < loop.size() ? k + 1 : 0];
    const LonLat& q = loop[k + 2 < loop.size() ? k + 2 : k + 2 - loop.size()];
    if (p == q || is_between(p, tip, q) || is_between(tip, q, p)) return true;
  }
  return false;
}

// True if a loop is counterclockwise; exact. Precondition: it is simple and not all on one line.
inline bool is_counterclockwise(std::span<const LonLat> loop) {
  const auto first = std::ranges::min_element(loop, InPlane());
  const auto k = static_cast<std::size_t>(first - loop.begin());
  const LonLat& before = loop[k == 0 ? loop.size() - 1 : k - 1];
  const LonLat& after = loop[k + 1 == loop.size() ? 0 : k + 1];
  return side_of_line(before, *first, after) == Sign::positive;
}

}  // namespace rondel::map
