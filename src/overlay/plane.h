// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Predicates for positions in the plane of longitude and latitude: exact signs, and the order from
// west to east.
#pragma once

#include <cmath>
#include <limits>

#include "rondel/predicates.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The largest distance in degrees of a corner from a side that is meant to pass through it: some
// roundings of a longitude.
constexpr double on_side_deg = 0x1p-42;

// Orders positions by longitude, then by latitude.
inline bool is_west_of(const LonLat& p, const LonLat& q) {
  return p.lon_deg != q.lon_deg ? p.lon_deg < q.lon_deg : p.lat_deg < q.lat_deg;
}

// This is is_west_of() as an object, which compilers put into the loops of algorithms.
struct IsWestOf {
  bool operator()(const LonLat& p, const LonLat& q) const { return is_west_of(p, q); }
};

// Returns positive if c is to the left of the line from a to b, negative if it is to the right;
// exact.
inline Sign side_of_line(const LonLat& a, const LonLat& b, const LonLat& c) {
  // This is the filter of Shewchuk's orient2d, whose bound is (3 + 16 u) u times the sum of the
  // products, u = 2^-53.
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  constexpr double bound = (3 + 16 * u) * u;
  const double left = (a.lon_deg - c.lon_deg) * (b.lat_deg - c.lat_deg);
  const double right = (a.lat_deg - c.lat_deg) * (b.lon_deg - c.lon_deg);
  const double determinant = left - right;
  const double least = bound * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  if (determinant > least) return Sign::positive;
  if (-determinant > least) return Sign::negative;
  // Where each product has a factor of zero, which no rounding makes, the sign is known: c is an end of
  // the line, or all three are on one meridian or parallel.
  const bool is_left_zero = a.lon_deg == c.lon_deg || b.lat_deg == c.lat_deg;
  const bool is_right_zero = a.lat_deg == c.lat_deg || b.lon_deg == c.lon_deg;
  if (is_left_zero && is_right_zero) return Sign::zero;
  const auto lifted = [](const LonLat& p) { return Point{p.lon_deg, p.lat_deg, 1}; };
  return orientation(lifted(a), lifted(b), lifted(c));
}

}  // namespace rondel::overlay
