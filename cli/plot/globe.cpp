// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "globe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

// The geometry of globe.h. Sines and cosines of the standard library are good enough here: pictures
// are no results that have to agree bit by bit.
constexpr double pi = std::numbers::pi;

Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Returns s a + t b.
Point combine(double s, const Point& a, double t, const Point& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

// The orthographic projection leaves out the depth z.
Spot spot(const Point& p) { return {p.x, p.y}; }

// An ellipse center + u cos t + v sin t, which is the projection of a circle of the sphere.
struct Ellipse {
  Spot center, u, v;

  [[nodiscard]] Spot at(double t) const {
    const double c = std::cos(t), s = std::sin(t);
    return {center.x + u.x * c + v.x * s, center.y + u.y * c + v.y * s};
  }
  [[nodiscard]] Spot derivative(double t) const {
    const double c = std::cos(t), s = std::sin(t);
    return {v.x * c - u.x * s, v.y * c - u.y * s};
  }
};

// The outline of the globe: the unit circle.
constexpr Ellipse limb{{0, 0}, {1, 0}, {0, 1}};

// Continues the path along the ellipse, in pieces of at most 30 degrees. The usual cubic for an
// angle d, with controls at the distance k = 4/3 tan(d/4) along the tangents, deviates from a unit
// circle by at most 4/27 sin^6(d/4) / cos^2(d/4), which is 7.5e-7 for 30 degrees. An affine image
// with axes of length at most 1 does not enlarge that.
void trace_ellipse(Pen& pen, const Ellipse& ellipse, double from, double to, Spot end) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / (pi / 6))));
  const double step = (to - from) / pieces;
  const double k = 4.0 / 3.0 * std::tan(step / 4);
  Spot p = ellipse.at(from), dp = ellipse.derivative(from);
  for (int i = 1; i <= pieces; ++i) {
    const double t = from + step * i;
    const Spot q = i == pieces ? end : ellipse.at(t);
    const Spot dq = ellipse.derivative(t);
    pen.curve_to({p.x + k * dp.x, p.y + k * dp.y}, {q.x - k * dq.x, q.y - k * dq.y}, q);
    p = q;
    dp = dq;
  }
}

// Continues the path from a along the shorter arc to b. A chord stays within 1 - cos(angle / 2),
// which is less than angle² / 8, of its arc.
void trace_shorter_arc(Pen& pen, const Point& a, const Point& b, double tolerance) {
  const Point difference = combine(1, b, -1, a);
  if (dot(difference, difference) < 8 * tolerance) {
    pen.line_to(spot(b));
    return;
  }
  const Point normal = cross(a, difference);
  const Point tangent = normalized(cross(normal, a));
  trace_ellipse(pen, {{0, 0}, spot(a), spot(tangent)}, 0, angle_between(a, b), spot(b));
}

// Returns the point where the arc between a front and a back point meets the limb.
Point limb_crossing(const Point& a, const Point& b) {
  const Point c = combine(std::abs(b.z), a, std::abs(a.z), b);
  return normalized({c.x, c.y, 0});
}

// Continues the path counterclockwise along the limb. The visible part of a convex region has at
// most half of the limb; a longer turn comes from an arc of length zero after rounding.
void trace_limb(Pen& pen, const Point& from, const Point& to) {
  const double start = std::atan2(from.y, from.x);
  double turn = std::atan2(to.y, to.x) - start;
  if (turn < 0) turn += 2 * pi;
  if (turn > 1.5 * pi) {
    pen.line_to(spot(to));
  } else {
    trace_ellipse(pen, limb, start, start + turn, spot(to));
  }
}

// True if a convex region without a corner in front covers the whole front. Then the middle of the
// front is to the left of its edges. A region that does not cover it has an edge with the middle to
// its right, or is as small as rounding errors. The chords of its edges may turn either way, as the
// arcs bend towards the limb.
bool is_all_in_front(std::span<const Point> corners) {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    if (a.x * b.y - a.y * b.x < -rounding) return false;
  }
  return signed_area(corners) > static_cast<double>(corners.size()) * rounding;
}

}  // namespace

// The frame at the center is east, north and up; up_deg turns east and north in the picture.
View::View(const LonLat& center, double up_deg) : forward_(unit_vector(center)) {
  const Point east = unit_vector({center.lon_deg + 90, 0});
  const Point north = cross(forward_, east);
  const Point turned = unit_vector({up_deg, 0});
  up_ = combine(turned.x, north, turned.y, east);
  right_ = combine(turned.x, east, -turned.y, north);
}

Point View::turn(const Point& p) const { return {dot(p, right_), dot(p, up_), dot(p, forward_)}; }

Point normalized(const Point& v) {
  const double scale = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const Point scaled{v.x / scale, v.y / scale, v.z / scale};
  const double length = std::sqrt(dot(scaled, scaled));
  return {scaled.x / length, scaled.y / length, scaled.z / length};
}

double angle_between(const Point& a, const Point& b) {
  const Point difference = combine(1, b, -1, a), sum = combine(1, b, 1, a);
  return 2 * std::atan2(std::sqrt(dot(difference, difference)), std::sqrt(dot(sum, sum)));
}

std::optional<std::pair<Point, Point>> visible_part(const Point& a, const Point& b, Side side) {
  const double sign = side == Side::front ? 1 : -1;
  const double za = sign * a.z, zb = sign * b.z;
  if (za <= 0 && zb <= 0) {
    if (side == Side::front && za == 0 && zb == 0) return std::pair{a, b};
    return std::nullopt;
  }
  if (za >= 0 && zb >= 0) return std::pair{a, b};
  const Point c = limb_crossing(a, b);
  return za > 0 ? std::pair{a, c} : std::pair{c, b};
}

void trace_arc(Pen& pen, const Point& a, const Point& b, Side side, double tolerance) {
  const auto part = visible_part(a, b, side);
  if (!part) return;
  pen.move_to(spot(part->first));
  trace_shorter_arc(pen, part->first, part->second, tolerance);
}

void trace_line(Pen& pen, std::span<const Point> points, Side side, double tolerance) {
  bool is_joined = false;  // the pen is at points[i]
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto part = visible_part(points[i], points[i + 1], side);
    if (part && !is_joined) pen.move_to(spot(part->first));
    if (part) trace_shorter_arc(pen, part->first, part->second, tolerance);
    is_joined = part && part->second == points[i + 1];
  }
}

void trace_circle(Pen& pen, const Point& axis, double radius_deg, Side side) {
  const double radius = radius_deg * pi / 180;
  const double sign = side == Side::front ? 1 : -1;
  // The circle is center + u cos t + v sin t with v horizontal in depth, so z is center.z + u.z cos
  // t, and u points to the nearest point of the circle in front, or on the back side to the
  // farthest one.
  const Point level =
      axis.x == 0 && axis.y == 0 ? Point{1, 0, 0} : normalized({-axis.y, axis.x, 0});
  const Point highest = cross(level, axis);
  const double rise = sign * highest.z < 0 ? -1 : 1;
  const Point u = combine(rise * std::sin(radius), highest, 0, highest);
  const Point v = combine(std::sin(radius), level, 0, level);
  const Point center = combine(std::cos(radius), axis, 0, axis);
  const Ellipse ellipse{spot(center), spot(u), spot(v)};
  const double height = sign * center.z, swing = sign * u.z;
  if (height + swing <= 0) return;
  const double half = height >= swing ? pi : std::acos(-height / swing);
  pen.move_to(ellipse.at(-half));
  trace_ellipse(pen, ellipse, -half, half, ellipse.at(half));
}

bool trace_region(Pen& pen, std::span<const Point> corners, double tolerance) {
  // The path begins at a corner in front, so that each part along the limb has a begin and an end.
  const auto first = std::find_if(corners.begin(), corners.end(),
                                  [](const Point& corner) { return corner.z > 0; });
  if (first == corners.end()) {
    if (!is_all_in_front(corners)) return false;
    pen.move_to({1, 0});
    trace_ellipse(pen, limb, 0, 2 * pi, {1, 0});
    return true;
  }
  const auto start = static_cast<std::size_t>(first - corners.begin());
  Point last = *first;
  pen.move_to(spot(*first));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[(start + i) % corners.size()];
    const Point& b = corners[(start + i + 1) % corners.size()];
    const auto part = visible_part(a, b, Side::front);
    if (!part) continue;
    if (a.z <= 0) trace_limb(pen, last, part->first);
    trace_shorter_arc(pen, part->first, part->second, tolerance);
    last = part->second;
  }
  return true;
}

}  // namespace rondel::cli
