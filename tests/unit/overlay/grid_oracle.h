// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Grids of meridians and parallels, and areas of convex cells in their boxes by integrals over longitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "unit/overlay/support.h"

namespace rondel::test {

inline constexpr long double half_turn = std::numbers::pi_v<long double>;

inline LonLatGrid regular_grid(std::size_t num_lon, std::size_t num_lat, double west = -180) {
  LonLatGrid grid;
  for (std::size_t k = 0; k <= num_lon; ++k) {
    grid.lon_deg.push_back(west + 360.0 * static_cast<double>(k) / static_cast<double>(num_lon));
  }
  for (std::size_t k = 0; k <= num_lat; ++k) {
    grid.lat_deg.push_back(-90 + 180.0 * static_cast<double>(k) / static_cast<double>(num_lat));
  }
  return grid;
}

struct LonLatBox {
  long double west, south, east, north;  // radians
};
inline LonLatBox box_of(const LonLatGrid& grid, std::size_t cell) {
  const std::size_t n = grid.lon_deg.size() - 1;
  const auto radians = [](double degrees) { return degrees * half_turn / 180; };
  const double one = grid.lat_deg[cell / n];
  const double other = grid.lat_deg[cell / n + 1];
  return {radians(grid.lon_deg[cell % n]), radians(std::min(one, other)),
          radians(grid.lon_deg[cell % n + 1]), radians(std::max(one, other))};
}

// The sines of the latitudes between which a meridian is in a convex cell, by halving all its sides' planes.
struct SineSpan {
  long double south = -1;
  long double north = 1;
};
inline SineSpan span_in(const LongRing& ring, long double lon, const LonLatBox& box) {
  // Where a plane is positive, on the meridian's half circle from pole to pole: an interval each.
  long double low = box.south;
  long double high = box.north;
  const LongVector out{std::cos(lon), std::sin(lon), 0};
  for (std::size_t k = 0; k < ring.size() && low < high; ++k) {
    const LongVector normal = cross_of(ring[k], ring[(k + 1) % ring.size()]);
    // normal . (cos(lat) out + sin(lat) z) >= 0
    const long double a = dot_of(normal, out);
    const long double zero = std::atan2(-a, normal.z);  // or this and 180 degrees
    const auto at = [&](long double lat) { return a * std::cos(lat) + normal.z * std::sin(lat); };
    for (const long double lat : {zero, zero > 0 ? zero - half_turn : zero + half_turn}) {
      if (lat <= low || lat >= high) continue;
      (at((lat + high) / 2) > 0 ? low : high) = lat;
    }
    if (at((low + high) / 2) < 0) high = low;
  }
  return {std::sin(low), std::sin(high)};
}

// Gauss and Legendre's rule of 5 points.
template <class Function>
long double gauss(const Function& f, long double low, long double high) {
  constexpr long double nodes[] = {
      -0.906179845938663992797626878299392965L, -0.538469310105683091036314420700208805L, 0,
      0.538469310105683091036314420700208805L, 0.906179845938663992797626878299392965L};
  constexpr long double shares[] = {
      0.236926885056189087514264040719917363L, 0.478628670499366468041291514835638193L,
      0.568888888888888888888888888888888889L, 0.478628670499366468041291514835638193L,
      0.236926885056189087514264040719917363L};
  const long double half = (high - low) / 2;
  long double sum = 0;
  for (std::size_t g = 0; g < 5; ++g) sum += half * shares[g] * f(low + half * (1 + nodes[g]));
  return sum;
}

// Intervals are halved until both halves agree with the whole.
template <class Function>
long double integral(const Function& f, long double low, long double high, long double whole,
                     int depth) {
  const long double middle = (low + high) / 2;
  const long double west = gauss(f, low, middle);
  const long double east = gauss(f, middle, high);
  if (depth == 0 || std::abs(west + east - whole) < 1e-17L) return west + east;
  return integral(f, low, middle, west, depth - 1) + integral(f, middle, high, east, depth - 1);
}

// The area of a convex cell in a box. The integrand has kinks where a side begins or ends.
inline long double area_in(const LongRing& ring, const LonLatBox& box) {
  if (ring.size() < 3) return 0;
  const auto height = [&](long double lon) {
    const SineSpan span = span_in(ring, lon, box);
    return span.north - span.south;
  };
  std::vector<long double> cuts = {box.west, box.east};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LongVector& p = ring[k];
    const LongVector& q = ring[(k + 1) % ring.size()];
    const LongVector normal = cross_of(p, q);
    // A corner, and where the side, going on, is next to a pole.
    const long double next_to_pole = std::atan2(normal.y, normal.x);
    std::vector<long double> lons = {std::atan2(p.y, p.x), next_to_pole, next_to_pole + half_turn};
    for (const long double lat : {box.south, box.north}) {
      // Where the plane meets the parallel: normal.x cos(lon) + normal.y sin(lon) = -normal.z tan(lat).
      const long double length = std::hypot(normal.x, normal.y);
      const long double cosine = -normal.z * std::tan(lat) / length;
      if (!(std::abs(cosine) <= 1)) continue;
      lons.push_back(next_to_pole + std::acos(cosine));
      lons.push_back(next_to_pole - std::acos(cosine));
    }
    for (const long double lon : lons) {
      for (int turn = -2; turn <= 2; ++turn) {
        const long double there = lon + turn * 2 * half_turn;
        if (there > box.west && there < box.east) cuts.push_back(there);
      }
    }
  }
  std::ranges::sort(cuts);
  long double area = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    area += integral(height, cuts[k], cuts[k + 1], gauss(height, cuts[k], cuts[k + 1]), 40);
  }
  return area;
}

}  // namespace rondel::test
