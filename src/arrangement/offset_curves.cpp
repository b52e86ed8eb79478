// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// In the plane that touches the sphere at the center of a circle, great circles are lines and a
// distance r from the center is tan r. So the side between corners at distances r and r', an angle
// a + b apart, is nowhere nearer than m if cos a = tan m / tan r and cos b = tan m / tan r'. The
// parallel at the distance r from a side is the circle of radius pi/2 - r around the pole of the
// side, and the same holds with cotangents.
#include "arrangement/offset_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "exact/vector.h"

namespace rondel::arrangement {
namespace {

exact::SineCosine sine_cosine(double radians) {
  return exact::sine_cosine_of_degrees(radians * exact::degrees_per_radian);
}

// Returns the angle with a cosine of 1 - versine, at most 1 radian.
double angle_of_versine(double versine) {
  return std::min(1.0, exact::argument(std::sqrt(versine * (2 - versine)), 1 - versine));
}

// Calls visit(angle) for each corner between the ends of a curve over an angle.
template <class Visit>
void visit_corners(double angle, const CornerSteps& steps, const Visit& visit) {
  if (!(angle > 2 * steps.end)) return;
  const double first = steps.end + steps.inner;
  const double num_inner = std::max(0.0, std::ceil((angle - 2 * first) / (2 * steps.inner)));
  const double scale = angle / (2 * first + num_inner * 2 * steps.inner);
  for (double k = 0; k <= num_inner; ++k) visit(scale * (first + k * 2 * steps.inner));
}

// Returns a unit vector whose coordinates are not so small that arrange() refuses them.
Point corner_at(const Point& from, const Point& towards, const exact::SineCosine& angle) {
  constexpr double least = 0x1p-120;
  const auto flushed = [](double x) { return std::abs(x) < least ? 0 : x; };
  const Point p = normalized(angle.cosine * from + angle.sine * towards);
  return {flushed(p.x), flushed(p.y), flushed(p.z)};
}

}  // namespace

OffsetCurves::OffsetCurves(double distance, double tolerance)
    : distance_(sine_cosine(distance)),
      tolerance_(sine_cosine(tolerance)),
      circle_corner_(sine_cosine(distance + tolerance)),
      parallel_corner_(sine_cosine(distance - tolerance)) {
  const exact::SineCosine& far = circle_corner_;
  const exact::SineCosine& near = parallel_corner_;
  const double inner = angle_of_versine(sine_cosine(2 * tolerance).sine / (near.cosine * far.sine));
  parallel_ = {angle_of_versine(tolerance_.sine / (distance_.cosine * far.sine)), inner};
  // Parallels meet at a distance from the common end of their sides whose sine is that of `distance`
  // over the cosine of half the angle. It is at most distance + tolerance; and parallels go at most
  // 30 degrees past the ends of their sides.
  const double versine =
      2 * sine_cosine(distance + tolerance / 2).cosine * sine_cosine(tolerance / 2).sine / far.sine;
  const double sine = std::sqrt(versine * (2 - versine));
  const bool is_limited = sine > distance_.cosine / 2;
  of_half_turn_.sine = is_limited ? distance_.cosine / 2 : sine;
  of_half_turn_.cosine = std::sqrt((1 - of_half_turn_.sine) * (1 + of_half_turn_.sine));
  half_turn_ = exact::argument(of_half_turn_.sine, of_half_turn_.cosine);
  meeting_ = of_meeting(of_half_turn_);
  // If it is limited, parallels end between the distance and that of corners.
  circle_ = {
      is_limited ? angle_of_versine(tolerance_.sine / (near.cosine * distance_.sine)) : inner,
      inner};
}

exact::SineCosine OffsetCurves::of_meeting(const exact::SineCosine& half) const {
  const double square = (distance_.cosine - half.sine) * (distance_.cosine + half.sine);
  return {distance_.sine / half.cosine, std::sqrt(square) / half.cosine};
}

void OffsetCurves::append_circle(const Point& center, Corners& corners) const {
  // An axis far from the center gives a direction.
  const Point axis = std::abs(center.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point right = normalized(cross(axis, center));
  const Point up = cross(center, right);
  const double number = std::max(3.0, std::ceil(std::numbers::pi / circle_.inner));
  for (double k = 0; k < number; ++k) {
    const exact::SineCosine angle = exact::sine_cosine_of_degrees(360 * k / number);
    corners.push_back(corner_at(center, angle.cosine * right + angle.sine * up, circle_corner_));
  }
}

Point OffsetCurves::at(const Point& center, const Point& direction) const {
  return corner_at(center, direction, distance_);
}

Point OffsetCurves::inner(const Point& center, const Point& direction) const {
  return corner_at(center, -1.0 * direction, tolerance_);
}

void OffsetCurves::append_turn(const Point& center, const Point& first, const Point& second,
                               Corners& corners) const {
  const Point left = cross(center, first);
  double angle = exact::argument(dot(left, second), dot(first, second));
  if (angle < -1) angle += 2 * std::numbers::pi;  // half a turn, but for rounding
  corners.push_back(begin_of_turn(center, first));
  visit_corners(angle - 2 * half_turn_, circle_, [&](double part) {
    const exact::SineCosine turn = sine_cosine(half_turn_ + part);
    corners.push_back(corner_at(center, turn.cosine * first + turn.sine * left, circle_corner_));
  });
  corners.push_back(end_of_turn(center, second));
}

Point OffsetCurves::begin_of_turn(const Point& center, const Point& first) const {
  const Point left = cross(center, first);
  return corner_at(center, of_half_turn_.cosine * first + of_half_turn_.sine * left, meeting_);
}

Point OffsetCurves::end_of_turn(const Point& center, const Point& second) const {
  const Point left = cross(center, second);
  return corner_at(center, of_half_turn_.cosine * second - of_half_turn_.sine * left, meeting_);
}

void OffsetCurves::append_parallel(const Point& begin, const Point& normal, const Point& from,
                                   const Point& to, Corners& corners) const {
  const Point ahead = cross(begin, normal);
  const auto longitude = [&](const Point& p) {
    return exact::argument(dot(p, ahead), dot(p, begin));
  };
  const double first = longitude(from);
  double last = longitude(to);
  if (last < -1) last += 2 * std::numbers::pi;  // it is past the end of a long side
  visit_corners(last - first, parallel_, [&](double part) {
    const exact::SineCosine way = sine_cosine(first + part);
    corners.push_back(corner_at(way.cosine * begin + way.sine * ahead, normal, parallel_corner_));
  });
}

bool OffsetCurves::can_meet(const Point& first, const Point& second) const {
  return norm(first - second) <= 2 * of_half_turn_.sine;
}

Point OffsetCurves::meeting(const Point& center, const Point& first, const Point& second) const {
  return corner_at(center, normalized(first + second),
                   of_meeting({norm(first - second) / 2, norm(first + second) / 2}));
}

bool OffsetCurves::is_long(const Point& from, const Point& to, const Point& first,
                           const Point& second) const {
  const double sine = norm(first - second) / 2;
  const double square = (distance_.cosine - sine) * (distance_.cosine + sine);
  return norm(to - from) * std::sqrt(square) >= 4 * sine * distance_.sine;
}

bool OffsetCurves::may_gape(const Point& first, const Point& second) const {
  constexpr double least_width = 0x1p-44;
  return norm(first - second) * distance_.sine < least_width && dot(first, second) > 0;
}

}  // namespace rondel::arrangement
