// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/arc.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "exact/angles.h"

namespace rondel::map {
namespace {

// A straight line in the plane whose longitude and latitude change by u and v (radians) has a
// geodesic acceleration of at most |u| (|u| + 2|v|). While it is short, it is therefore within an
// eighth of that of the arc with the same ends. The factor of a seventh leaves room for the
// curvature of the sphere.
bool is_surely_flat(const MapPoint& p, const MapPoint& q, double tolerance) {
  const double u = std::abs(q.position.lon_deg - p.position.lon_deg) / degrees_per_radian;
  const double v = std::abs(q.position.lat_deg - p.position.lat_deg) / degrees_per_radian;
  return u + v < 0.1 && u * (u + 2 * v) <= 7 * tolerance;
}

// Returns the angle between two unit vectors in radians.
double angle(const Point& p, const Point& q) {
  const double sine = std::min(1.0, norm(p - q) / 2);
  return 2 * exact::argument(sine, std::sqrt(1 - sine * sine));
}

// Returns the tolerance where the arc comes closest to the center. By the triangle inequality on
// the sphere, the arc stays at least half as far from the center as the detour through the center
// is longer than the arc.
double tolerance_along(const Point& p, const Point& q, const ArcTolerance& arc) {
  if (arc.least == arc.most) return arc.most;
  const double detour = angle(p, arc.center) + angle(q, arc.center);
  const double distance = (detour - angle(p, q)) / 2;
  return std::min(arc.most, std::max(arc.least, distance / 8));
}

// True if the straight line is within the tolerance of the arc, judged by the distance of three of
// its points from the plane of the great circle. The circle has at most one inflection between p
// and q in the plane of the map, so the distance vanishes at most once inside, and its maximum is
// at most 1.1 times the largest of the three.
bool is_flat(const MapPoint& p, const MapPoint& q, const ArcTolerance& arc) {
  if (is_surely_flat(p, q, arc.least)) return true;
  const Point chord = q.point - p.point;
  const double tolerance = tolerance_along(p.point, q.point, arc);
  if (norm(chord) <= tolerance) return true;
  const Point normal = cross(p.point, chord);
  const double limit = 0.9 * tolerance * norm(normal);
  const auto is_near = [&](double t) {
    const LonLat place{std::lerp(p.position.lon_deg, q.position.lon_deg, t),
                       std::lerp(p.position.lat_deg, q.position.lat_deg, t)};
    return std::abs(dot(normal, point_at(place) - p.point)) <= limit;
  };
  return is_near(0.5) && is_near(0.25) && is_near(0.75);
}

void bisect(const MapPoint& p, const MapPoint& q, const ArcTolerance& tolerance,
            std::vector<MapPoint>& out) {
  if (is_flat(p, q, tolerance)) return;
  const Point chord = p.point + q.point;
  if (chord == Point{}) return;  // antipodes, which no arc of a diagram joins
  MapPoint middle;
  middle.point = normalized(chord);
  if (middle.point == p.point || middle.point == q.point) return;
  // An end on the antimeridian has the sign of longitude of the side on which the arc lies.
  const double side = std::abs(p.position.lon_deg) > std::abs(q.position.lon_deg)
                          ? p.position.lon_deg
                          : q.position.lon_deg;
  middle.position = lonlat_of(middle.point, side > 0);
  bisect(p, middle, tolerance, out);
  out.push_back(middle);
  bisect(middle, q, tolerance, out);
}

// Returns the nearest position with so many decimals at most. 10^k and the rounded product are
// exact, so that a coordinate is what a file with these digits is read as. No zero has a sign.
LonLat with_decimals(const LonLat& position, double power) {
  return {std::rint(position.lon_deg * power) / power + 0.0,
          std::rint(position.lat_deg * power) / power + 0.0};
}

}  // namespace

Point snapped(const Point& p) {
  if (distance_from_axis(p) <= merge_distance) return {0, 0, p.z > 0 ? 1.0 : -1.0};
  if (p.x < 0 && std::abs(p.y) <= merge_distance) return {p.x, 0, p.z};
  return p;
}

Point point_at(const LonLat& position) {
  const exact::SineCosine lon = exact::sine_cosine_of_degrees(position.lon_deg);
  const exact::SineCosine lat = exact::sine_cosine_of_degrees(position.lat_deg);
  return {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
}

LonLat shortened(const LonLat& position, const Point& p) {
  constexpr double near_deg = 1e-12;  // more than rounding moves longitudes, except next to a pole
  const auto fits = [&](const LonLat& candidate) {
    return std::abs(candidate.lon_deg - position.lon_deg) <= near_deg &&
           std::abs(candidate.lat_deg - position.lat_deg) <= near_deg && point_at(candidate) == p;
  };
  // Few points have such a position. Rounding moves a longitude by less than half of the twelfth
  // decimal, so that nothing shorter fits if 12 decimals do not, except next to a pole.
  if (std::abs(position.lat_deg) > 80 || fits(with_decimals(position, 1e12))) {
    for (double power = 1; power <= 1e12; power *= 10) {
      const LonLat candidate = with_decimals(position, power);
      if (fits(candidate)) return candidate;
    }
  }
  const LonLat longest = with_decimals(position, 1e13);
  return fits(longest) ? longest : position;
}

LonLat with_unit_vector(const LonLat& position, const Point& p) {
  LonLat found = position;
  visit_around(position, 0, [&](const LonLat& candidate) {
    if (!(point_at(candidate) == p)) return false;
    found = candidate;
    return true;
  });
  return found;
}

LonLat as_written(const LonLat& position, const Point& p) {
  constexpr double rounding_deg = 0x1p-44;  // of unit vectors and of their longitudes
  const LonLat written = with_decimals(position, 1e9);
  const bool is_lon_near = std::abs(written.lon_deg - position.lon_deg) <= rounding_deg;
  const bool is_lat_near = std::abs(written.lat_deg - position.lat_deg) <= rounding_deg;
  if (is_lon_near && is_lat_near) return written;
  const LonLat exact = shortened(position, p);
  if (!(exact == position)) return exact;
  return {is_lon_near ? written.lon_deg : position.lon_deg,
          is_lat_near ? written.lat_deg : position.lat_deg};
}

bool is_surely_one_line(const MapPoint& p, const MapPoint& q, double tolerance) {
  const Point& a = p.point;
  const Point& b = q.point;
  return is_east(a) == is_east(b) && !is_pole(a) && !is_pole(b) && is_surely_flat(p, q, tolerance);
}

std::optional<Point> foot_on_arc(const Point& v, const Point& p, const Point& q) {
  const Point normal = normalized(cross(p, q - p));
  const double height = dot(normal, v - p);
  const Point foot = normalized(v - height * normal);
  const bool is_inside =
      dot(normal, cross(p, foot - p)) > 0 && dot(normal, cross(foot, q - foot)) > 0;
  return is_inside ? std::optional(foot) : std::nullopt;
}

void append_arc(const MapPoint& p, const MapPoint& q, const ArcTolerance& tolerance,
                std::vector<MapPoint>& out) {
  const auto key = [](const Point& a) { return std::tie(a.x, a.y, a.z); };
  if (key(p.point) < key(q.point)) {
    bisect(p, q, tolerance, out);
    return;
  }
  const auto start = static_cast<std::ptrdiff_t>(out.size());
  bisect(q, p, tolerance, out);
  std::reverse(out.begin() + start, out.end());
}

}  // namespace rondel::map
