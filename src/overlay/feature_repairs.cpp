// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/feature_repairs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "arrangement/even_odd.h"
#include "exact/vector.h"
#include "overlay/feature_polygons.h"
#include "rondel/delaunay.h"

namespace rondel::overlay {
namespace {

// Returns a longitude from 0 to below 360, up to rounding.
double turned(double lon_deg) {
  const double lon = std::remainder(lon_deg, 360.0);
  return lon < 0 ? lon + 360 : lon;
}

// Returns the middle of the widest gap between longitudes from 0 to below 360.
double middle_of_gap(std::vector<double> longitudes) {
  std::ranges::sort(longitudes);
  double before = longitudes.back() - 360;
  double width = 0;
  double middle = 0;
  for (const double lon : longitudes) {
    if (lon - before > width) {
      width = lon - before;
      middle = before + width / 2;
    }
    before = lon;
  }
  return middle;
}

// Returns whether an odd number of sides leads along a pole over a meridian.
bool is_along_pole(std::span<const PlaneSide> sides, double pole_deg, double lon_deg) {
  std::size_t count = 0;
  for (const PlaneSide& side : sides) {
    if (side.from.lat_deg != pole_deg || side.to.lat_deg != pole_deg) continue;
    const auto [west, east] = std::minmax(side.from.lon_deg, side.to.lon_deg);
    count += static_cast<std::size_t>(std::floor((east - lon_deg) / 360) -
                                      std::floor((west - lon_deg) / 360));
  }
  return count % 2 != 0;
}

// Returns whether the sides of a polygon go around the globe an odd number of times.
bool is_around_pole(std::span<const PlaneSide> sides) {
  double turns = 0;
  for (const PlaneSide& side : sides) turns += (side.to.lon_deg - side.from.lon_deg) / 360;
  return std::remainder(std::round(turns), 2.0) != 0;
}

// Returns what is known of the pole farther from the sides of a polygon, or, if an odd number of
// rings goes around a pole, of the one on the other side of the equator.
arrangement::KnownPlace known_pole(std::span<const PlaneSide> sides) {
  double south = 90;
  double north = -90;
  double sum = 0;
  std::vector<double> longitudes;
  for (const PlaneSide& side : sides) {
    south = std::min(south, side.from.lat_deg);
    north = std::max(north, side.from.lat_deg);
    sum += side.from.lat_deg;
    longitudes.push_back(turned(side.from.lon_deg));
  }
  const bool is_south = is_around_pole(sides) ? sum > 0 : south + 90 > 90 - north;
  const double pole_deg = is_south ? -90 : 90;
  const double lon_deg = middle_of_gap(std::move(longitudes));
  return {unit_vector({0, pole_deg}), unit_vector({lon_deg, 0}),
          is_along_pole(sides, pole_deg, lon_deg)};
}

// Returns the place opposite to the middle of a ring, which is outside of its smaller side if its
// corners are in a hemisphere.
std::optional<arrangement::KnownPlace> known_outside(std::span<const Point> ring) {
  Point sum = {};
  for (const Point& corner : ring) sum = sum + corner;
  const Point middle = normalized(sum);
  constexpr double least_cosine = 1e-9;
  const bool is_in_hemisphere = std::ranges::all_of(
      ring, [&](const Point& corner) { return dot(middle, corner) > least_cosine; });
  if (!is_in_hemisphere) return std::nullopt;
  return arrangement::KnownPlace{-1.0 * middle, middle, false};
}

}  // namespace

bool goes_shorter_way(const map::LonLatRing& ring) {
  if (ring.is_turn) return true;
  const std::vector<LonLat>& positions = ring.positions;
  const std::size_t size = positions.size();
  const auto is_meridian = [&](std::size_t from, std::size_t to) {
    return positions[from % size].lon_deg == positions[to % size].lon_deg;
  };
  for (std::size_t k = 0; k < size; ++k) {
    const LonLat& from = positions[k];
    const LonLat& to = positions[(k + 1) % size];
    const bool is_at_pole = std::abs(from.lat_deg) == 90 && std::abs(to.lat_deg) == 90;
    const bool is_of_box = is_meridian(k + size - 1, k) && is_meridian(k + 1, k + 2);
    if (std::abs(to.lon_deg - from.lon_deg) > 180 && !is_at_pole && !is_of_box) return true;
  }
  return false;
}

std::vector<PlaneSide> given_sides(std::span<const map::LonLatRing> rings) {
  std::vector<PlaneSide> sides;
  for (const map::LonLatRing& ring : rings) {
    const std::size_t size = ring.positions.size();
    for (std::size_t k = 0; k < size; ++k) {
      PlaneSide side = {ring.positions[k], ring.positions[k + 1 < size ? k + 1 : 0]};
      if (ring.is_shorter) side.to = map::end_of_shorter(side.from, side.to);
      sides.push_back(side);
    }
  }
  return sides;
}

CellRings repaired_plane_feature(std::span<const map::LonLatRing> rings,
                                 std::span<const std::span<const LonLat>> corners,
                                 const Execution& execution) {
  const std::vector<PlaneSide> sides = given_sides(rings);
  CellRings polygons;
  std::vector<std::optional<arrangement::KnownPlace>> known;
  std::size_t first_side = 0;  // of the polygon
  std::size_t side = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t k = 0; k < rings[r].positions.size(); ++k, ++side) {
      for (const LonLat& corner : corners[side]) {
        polygons.corners.push_back(static_cast<Index>(polygons.points.size()));
        polygons.points.push_back(unit_vector(corner));
      }
    }
    polygons.end_ring();
    if (r + 1 < rings.size() && rings[r + 1].is_hole) continue;
    polygons.end_cell();
    const auto of_polygon = std::span(sides).subspan(first_side, side - first_side);
    known.emplace_back(of_polygon.empty() ? arrangement::KnownPlace{{0, 0, 1}, {1, 0, 0}, false}
                                          : known_pole(of_polygon));
    first_side = side;
  }
  return arrangement::even_odd_union(polygons, known, execution);
}

CellRings repaired_geodesic_feature(std::span<const map::LonLatRing> rings,
                                    const Execution& execution) {
  CellRings polygons;
  std::vector<std::optional<arrangement::KnownPlace>> known;
  std::vector<Point> corners;  // of a polygon
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const GeodesicRing ring = geodesic_ring(rings[r]);
    for (const Point& corner : ring.corners) {
      polygons.corners.push_back(static_cast<Index>(polygons.points.size()));
      polygons.points.push_back(corner);
      corners.push_back(corner);
    }
    polygons.end_ring();
    if (r + 1 < rings.size() && rings[r + 1].is_hole) continue;
    polygons.end_cell();
    known.push_back(known_outside(corners));
    corners.clear();
  }
  return arrangement::even_odd_union(polygons, known, execution);
}

}  // namespace rondel::overlay
