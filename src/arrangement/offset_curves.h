// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Corners of polygons whose borders are near to the places at a distance from a point or a side.
//
// A side of a great circle bends away from a circle around a point, and towards the circle from a
// parallel of a side. So corners of a circle are beyond the distance, corners of a parallel before it:
//
//     circle      d + t  *-----.-----*        parallel    d + t    ___.----.___
//                 d       `           `                   d      .'           `.
//                 d - t       center                      d - t *    a side     *
//
// A parallel ends at the distance d from its side: above the end of the side where the border turns
// to its outside, else past the end, where it meets the next parallel, or a circle's corner.
#pragma once

#include <vector>

#include "exact/angles.h"
#include "rondel/types.h"

namespace rondel::arrangement {

using Corners = std::vector<Point>;

// The angle between two corners, as seen from the center of a circle or from the pole of a parallel:
// twice `inner` between two inner ones, `end + inner` between one at its end and the next one.
struct CornerSteps {
  double end;
  double inner;
};

class OffsetCurves {
 public:
  // Preconditions: 0 < tolerance <= distance / 2, distance + tolerance < pi / 2.
  OffsetCurves(double distance, double tolerance);

  // Appends a whole circle, counterclockwise.
  void append_circle(const Point& center, Corners& corners) const;
  // Returns the place at the distance in a direction, a unit vector at right angles to the center.
  [[nodiscard]] Point at(const Point& center, const Point& direction) const;
  // Returns the place at the tolerance in the opposite direction.
  [[nodiscard]] Point inner(const Point& center, const Point& direction) const;
  // Appends corners between two parallels whose sides meet in a point, from the last corner of the
  // first one to the first corner of the second one, counterclockwise; the normals of the sides are
  // so far apart that the parallels do not meet.
  void append_turn(const Point& center, const Point& first, const Point& second,
                   Corners& corners) const;
  // Returns the last and the first corner of append_turn().
  [[nodiscard]] Point begin_of_turn(const Point& center, const Point& first) const;
  [[nodiscard]] Point end_of_turn(const Point& center, const Point& second) const;
  // Appends what is between two places at the distance to the right of a side that begins at a
  // place; `normal` is the unit vector to the right.
  void append_parallel(const Point& begin, const Point& normal, const Point& from, const Point& to,
                       Corners& corners) const;
  // True if the parallels of two sides with these normals meet within the tolerance.
  [[nodiscard]] bool can_meet(const Point& first, const Point& second) const;
  // Returns the place where the parallels of two sides from a point meet.
  [[nodiscard]] Point meeting(const Point& center, const Point& first, const Point& second) const;
  // True if a side is so long that its parallel does not end before the one of another side begins.
  [[nodiscard]] bool is_long(const Point& from, const Point& to, const Point& first,
                             const Point& second) const;
  // True if the parallels of two sides that meet at less than 180 degrees are so near to each other
  // at their ends that rounding may leave a gap.
  [[nodiscard]] bool may_gape(const Point& first, const Point& second) const;

 private:
  // Returns what the distance of the meeting place has, by half of the angle between two sides.
  [[nodiscard]] exact::SineCosine of_meeting(const exact::SineCosine& half) const;

  exact::SineCosine distance_;
  exact::SineCosine tolerance_;
  exact::SineCosine circle_corner_;    // of the distance of a corner
  exact::SineCosine parallel_corner_;  // the same
  // Half of the largest angle between two sides whose parallels meet.
  double half_turn_;
  exact::SineCosine of_half_turn_;
  exact::SineCosine meeting_;  // of the distance of the place where they meet
  CornerSteps circle_;
  CornerSteps parallel_;
};

}  // namespace rondel::arrangement
