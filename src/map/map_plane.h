// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Exact signs in the plane of longitude and latitude, of positions as doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::map {

// A position's order: by longitude, then by latitude.
struct InPlane {
  bool operator()(const LonLat& p, const LonLat& q) const {
    return p.lon_deg != q.lon_deg ? p.lon_deg < q.lon_deg : p.lat_deg < q.lat_deg;
  }
};

// Degrees, along the axes.
inline double distance_in_plane(const LonLat& p, const LonLat& q) {
  return std::abs(p.lon_deg - q.lon_deg) + std::abs(p.lat_deg - q.lat_deg);
}

// Whether a line that ends at one position may end at the other instead. Next to a pole points that are near each other on
// the sphere have any longitudes, and the line would be elsewhere all the way.
inline bool are_near_in_plane(const LonLat& p, const LonLat& q) {
  constexpr double most = 1e-6;
  return distance_in_plane(p, q) <= most;
}

// Positive if r is to the left of the line from p to q; exact. The rounded determinant is off by at most (3 + 16 u) u
// times the sum of its two products, u = 2^-53 (Shewchuk 1997, Orient2D), which 2^-51 exceeds; the smallest normal
// number covers products that underflow.
inline Sign side_of_line(const LonLat& p, const LonLat& q, const LonLat& r) {
  const double left = (q.lon_deg - p.lon_deg) * (r.lat_deg - p.lat_deg);
  const double right = (q.lat_deg - p.lat_deg) * (r.lon_deg - p.lon_deg);
  const double bound = 0x1p-51 * (std::abs(left) + std::abs(right)) + 0x1p-1022;
  if (left - right > bound) return Sign::positive;
  if (left - right < -bound) return Sign::negative;
  return orientation({p.lon_deg, p.lat_deg, 1}, {q.lon_deg, q.lat_deg, 1},
                     {r.lon_deg, r.lat_deg, 1});
}

// Whether p lies in the rectangle around a line.
inline bool is_beside(const LonLat& a, const LonLat& b, const LonLat& p) {
  const auto [west, east] = std::minmax(a.lon_deg, b.lon_deg);
  const auto [south, north] = std::minmax(a.lat_deg, b.lat_deg);
  return west <= p.lon_deg && p.lon_deg <= east && south <= p.lat_deg && p.lat_deg <= north;
}

// Whether p is on the line between a and b and none of them; exact.
inline bool is_between(const LonLat& a, const LonLat& b, const LonLat& p) {
  return is_beside(a, b, p) && !(p == a) && !(p == b) && side_of_line(a, b, p) == Sign::zero;
}

// Whether two lines cross at a point inside of both; exact.
inline bool do_lines_cross(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  const Sign sign_c = side_of_line(a, b, c);
  const Sign sign_d = side_of_line(a, b, d);
  if (sign_c == sign_d || sign_c == Sign::zero || sign_d == Sign::zero) return false;
  const Sign sign_a = side_of_line(c, d, a);
  const Sign sign_b = side_of_line(c, d, b);
  return sign_a != sign_b && sign_a != Sign::zero && sign_b != Sign::zero;
}

// Whether, counterclockwise around a position from the east on, x comes before y; exact.
inline bool is_before_around(const LonLat& at, const LonLat& x, const LonLat& y) {
  const auto is_low = [&](const LonLat& p) {
    return p.lat_deg < at.lat_deg || (p.lat_deg == at.lat_deg && p.lon_deg < at.lon_deg);
  };
  if (is_low(x) != is_low(y)) return is_low(y);
  return side_of_line(at, x, y) == Sign::positive;
}

// Whether a loop goes back on the line on which it came.
inline bool has_spike(std::span<const LonLat> loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const LonLat& p = loop[k];
    const LonLat& tip = loop[k + 1 < loop.size() ? k + 1 : 0];
    const LonLat& q = loop[k + 2 < loop.size() ? k + 2 : k + 2 - loop.size()];
    if (p == q || is_between(p, tip, q) || is_between(tip, q, p)) return true;
  }
  return false;
}

// Whether a simple loop, not all on one line, is counterclockwise; exact.
inline bool is_counterclockwise(std::span<const LonLat> loop) {
  const auto first = std::ranges::min_element(loop, InPlane());
  const auto k = static_cast<std::size_t>(first - loop.begin());
  const LonLat& before = loop[k == 0 ? loop.size() - 1 : k - 1];
  const LonLat& after = loop[k + 1 == loop.size() ? 0 : k + 1];
  return side_of_line(before, *first, after) == Sign::positive;
}

}  // namespace rondel::map
