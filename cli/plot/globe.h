// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The orthographic globe: points and arcs of the unit sphere as curves in the unit disc. The
/// curves go to a Pen, so that this file does not depend on a drawing library.
///
/// The *view frame* has x to the right, y up and z towards the viewer, so (x, y) is the picture,
/// and the *limb*, the circle z = 0, is the outline of the globe. A circle of the sphere
/// projects to an ellipse, and arcs of an ellipse are drawn as cubic Béziers; an
/// arc that crosses the limb is cut there, because its hidden part would run over the disc.
///
///          front  z > 0
///        . - - - .           an arc a b between both sides is
///      /    a     \          drawn from a to c (Side::front)
///     |      \     |         and from c to b (Side::back),
///     |       \    |         where c, on the limb, is the
///      \       `c /          crossing: a |b.z| + b |a.z|, normalised
///        ' - - - ' `b
///
/// in    unit vectors in the view frame; angles in degrees where the name says so, else in radians
/// out   lines and Bézier curves in the unit disc
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "rondel/types.h"

namespace rondel::cli {

/// A place in the picture. The globe is the unit disc.
struct Spot {
  double x = 0;
  double y = 0;
};

/// Returns the area of a polygon without holes as seen in the picture, in squares of the unit of
/// its corners. It is positive if the corners turn in the direction from the x-axis to the y-axis.
template <class Place>
double signed_area(std::span<const Place> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Place& p = corners[i];
    const Place& q = corners[(i + 1) % corners.size()];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum / 2;
}

/// Receives the curves of a picture.
class Pen {
 public:
  virtual ~Pen() = default;
  /// Begins a new curve at a place.
  virtual void move_to(Spot to) = 0;
  /// Continues the curve by a straight line.
  virtual void line_to(Spot to) = 0;
  /// Continues the curve by a cubic Bézier curve with two control points.
  virtual void curve_to(Spot control1, Spot control2, Spot to) = 0;
};

/// The direction from which the globe is viewed.
class View {
 public:
  /// `center` (degrees) is in the middle of the picture, and the direction `up_deg` degrees
  /// clockwise from north at the center points up.
  explicit View(const LonLat& center, double up_deg = 0);

  /// Returns a vector in the view frame.
  [[nodiscard]] Point turn(const Point& p) const;

 private:
  /// The axes x, y, z of the view frame as unit vectors of the globe.
  Point right_, up_, forward_;
};

/// The hemisphere towards the viewer, and the one behind.
enum class Side { front, back };

/// Returns the unit vector of v. \pre v is finite and not zero
Point normalized(const Point& v);

/// Returns the angle between two unit vectors in radians, accurate also if it is tiny or near 180
/// degrees.
double angle_between(const Point& a, const Point& b);

/// Returns the part of the shorter arc from a to b on one side of the globe, or nothing.
/// 1. A cut end lies on the limb: z = 0 and x² + y² = 1 to a few ulp.
/// 2. An arc along the limb belongs to the front.
/// 3. The choice rests on the signs of a.z and b.z alone, so that arcs with a common end agree.
/// \pre unit vectors in the view frame, not antipodal.
std::optional<std::pair<Point, Point>> visible_part(const Point& a, const Point& b, Side side);

/// Traces the shorter arc from a to b where it is on that side. Curves are within `tolerance` of
/// the projected arc, or within 1e-6 if that is more.
void trace_arc(Pen& pen, const Point& a, const Point& b, Side side, double tolerance);

/// Traces a line of shorter arcs from point to point; each part on that side is traced without a
/// break. \pre like visible_part() for successive points
void trace_line(Pen& pen, std::span<const Point> points, Side side, double tolerance);

/// Traces the visible parts of the circle of radius `radius_deg` (90: a great circle)
/// around `axis`, a unit vector in the view frame.
void trace_circle(Pen& pen, const Point& axis, double radius_deg, Side side);

/// Traces the outline of the visible part of a convex region of the sphere, given by its corners
/// counterclockwise seen from outside; where the region goes beyond the limb the outline follows
/// the limb. Returns false if nothing is visible.
/// \param corners  unit vectors in the view frame
/// \param tolerance  as of trace_arc(), in radii of the globe
bool trace_region(Pen& pen, std::span<const Point> corners, double tolerance);

}  // namespace rondel::cli
