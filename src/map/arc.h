// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs of great circles, drawn as polylines in the plane of longitude and latitude.
//
// in    unit vectors, tolerances in radians
// out   unit vectors with longitudes and latitudes in degrees
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::map {

using exact::degrees_per_radian;
using exact::distance_from_axis;
using exact::is_pole;
using exact::lonlat_of;

// Points of a map that are nearer to each other than this are one point, and a point that is this
// near to a pole or to the antimeridian lies on it. The unit is radians, and the value 0.1
// micrometer on the earth. Circumcenters are off by up to 4 * 2^-53 and a longitude or latitude in
// degrees by 2 * 2^-53 more; points that are farther apart than 20 times that keep their order when
// they are rounded.
inline constexpr double merge_distance = 0x1p-46;

// Returns the pole or the point of the antimeridian within merge_distance of p, or p itself.
Point snapped(const Point& p);

// Returns the unit vector of a position.
Point point_at(const LonLat& position);

// Returns the unit vector from the center to a site at any distance, or zero for the center itself.
inline Point direction(const Point& site, const Point& center) {
  return normalized(scaled(site - center));
}

// Returns the length of the chord from p to q.
inline double distance(const Point& p, const Point& q) { return norm(p - q); }

// Returns the point of the arc from p to q that is nearest to v, or nothing if that is an end of
// the arc.
std::optional<Point> foot_on_arc(const Point& v, const Point& p, const Point& q);

// A point with its place on the map.
struct MapPoint {
  Point point;      // a unit vector
  LonLat position;  // degrees
};

// True if a point is drawn in the east. A point on the antimeridian is: think of the antimeridian
// as shifted to the west by an infinitesimal, so that every point but a pole is on one side of it.
inline bool is_east(const Point& p) { return p.y >= 0; }

// A unit vector is that of many longitudes and latitudes: `computed` are those of lonlat_of(), and
// `written` those of as_written().
enum class MapPositions : std::uint8_t { computed, written };

// Returns the position with the fewest decimals that has this unit vector, if one of up to 12
// decimals has; or one of 13 decimals next to the given one that has; or the given one.
LonLat shortened(const LonLat& position, const Point& p);

// Calls visit(candidate) for a position and those around it, the nearest first, until it returns true:
// up to four steps in both numbers, of a unit in the last place but at least `least_step` degrees.
// Latitudes stay on the sphere.
template <class Visit>
void visit_around(const LonLat& position, double least_step, const Visit& visit) {
  constexpr int farthest = 4;
  const auto step_of = [&](double x) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return std::max(std::nextafter(std::abs(x), infinity) - std::abs(x), least_step);
  };
  const double lon_step = step_of(position.lon_deg);
  const double lat_step = step_of(position.lat_deg);
  for (int radius = 0; radius <= farthest; ++radius) {
    for (int i = -radius; i <= radius; ++i) {
      // Only the first and the last rows of the square are whole.
      const int step = std::abs(i) == radius ? 1 : 2 * radius;
      for (int j = -radius; j <= radius; j += step) {
        const LonLat candidate = {position.lon_deg + i * lon_step, position.lat_deg + j * lat_step};
        if (std::abs(candidate.lat_deg) <= 90 && visit(candidate)) return;
      }
    }
  }
}

// Returns a position within some units in the last place of the given one that has this unit vector,
// the nearest of them; or the given one if there is none.
LonLat with_unit_vector(const LonLat& position, const Point& p);

// Returns the position that stands for a point in a file: the shortened() one, but each coordinate
// that is a number of up to 9 decimals up to rounding is that number.
LonLat as_written(const LonLat& position, const Point& p);

// Returns a point with its position on the side of the antimeridian that is given.
inline MapPoint map_point(const Point& p, bool east, MapPositions positions) {
  const LonLat position = lonlat_of(p, east);
  return {p, positions == MapPositions::computed ? position : as_written(position, p)};
}

inline MapPoint map_point(const Point& p, MapPositions positions = MapPositions::computed) {
  return map_point(p, is_east(p), positions);
}

// How far a polyline may be from its arc, in radians: `least` at the point `center`, which is
// between two sites, and an eighth of the distance from `center` farther away, but at most `most`.
// Polylines then keep clear of both sites and still have few points on long arcs between close
// sites.
struct ArcTolerance {
  double least = 0;
  double most = 0;
  Point center{};
};

// Appends points that cut the arc from p to q into pieces, in order and without p and q. The
// straight line of each piece in longitude and latitude is within the tolerance of the piece.
//
// 1. The points of the arc from q to p are bit by bit the same in reverse order.
// 2. They depend only on p, q, their longitudes and the tolerance.
//
// Precondition: the arc meets no pole, and meets the antimeridian at most in its ends.
void append_arc(const MapPoint& p, const MapPoint& q, const ArcTolerance& tolerance,
                std::vector<MapPoint>& out);

// True if a cheap test finds that the arc is drawn as one straight line: it is within `tolerance`
// (radians) of that line and on one side of the antimeridian and of the meridian of 0 degrees.
bool is_surely_one_line(const MapPoint& p, const MapPoint& q, double tolerance);

}  // namespace rondel::map
