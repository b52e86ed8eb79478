// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arcs of great circles in the plane of longitude and latitude.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "exact/vector.h"
#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::map {

inline constexpr double degrees_per_radian = 180 / std::numbers::pi;

// Points of a map nearer than this (radians; 0.1 micrometer on the earth) are one point, and what
// is that near to a pole or to the antimeridian lies on it. The centers of circumcircles are
// off by up to 4 * 2^-53 and a longitude or latitude in degrees by 2 * 2^-53 more:
// whatever is farther apart than 20 times that is still in its order when it is rounded.
inline constexpr double merge_distance = 0x1p-46;

inline bool is_pole(const Point& p) { return p.x == 0 && p.y == 0; }

// The point itself, or the pole or point of the antimeridian within merge_distance.
Point snapped(const Point& p);

inline double distance_from_axis(const Point& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

// Longitude and latitude of a unit vector that is not a pole. A point on the antimeridian has two
// longitudes; it gets the one on the side of `east`: 180 if true, else -180.
RONDEL_API LonLat lonlat_of(const Point& p, bool east);

// The unit vector of a position.
Point point_at(const LonLat& position);

// The unit vector from the center to a site of any size; zero for the center itself.
inline Point direction(const Point& site, const Point& center) {
  return normalized(scaled(site - center));
}

inline double distance(const Point& p, const Point& q) { return norm(p - q); }

// The point between p and q on their arc that is nearest to v; none if that is an end.
std::optional<Point> foot_on_arc(const Point& v, const Point& p, const Point& q);

struct MapPoint {
  Point point;
  LonLat position;
};

// The antimeridian belongs to the east: think of it as shifted by an infinitesimal to the west, so
// that every point but a pole is on one side.
inline bool is_east(const Point& p) { return p.y >= 0; }

inline MapPoint map_point(const Point& p) { return {p, lonlat_of(p, is_east(p))}; }

// How far the straight lines may be from an arc (radians): `least` at the point `center`, which is
// between two sites, from there on an eighth of the distance from it, but at most `most`.
// So the lines keep clear of both sites and are still few on long arcs between close sites.
struct ArcTolerance {
  double least = 0;
  double most = 0;
  Point center{};
};

// Appends the points, in order and without the ends, that cut the arc from p to q into pieces whose
// straight lines in longitude and latitude are within the tolerance of them.
// 1. The points of the arc from q to p are bit by bit the same in reverse order.
// 2. They depend on nothing but p, q, their longitudes and the tolerance.
// Precondition: the arc meets neither a pole nor, its ends apart, the antimeridian.
void append_arc(const MapPoint& p, const MapPoint& q, const ArcTolerance& tolerance,
                std::vector<MapPoint>& out);

// Whether a cheap test finds that the arc is drawn as one straight line, from end to end within
// `tolerance` of it (radians) and on one side of the antimeridian and of the meridian opposite.
bool is_surely_one_line(const MapPoint& p, const MapPoint& q, double tolerance);

}  // namespace rondel::map
