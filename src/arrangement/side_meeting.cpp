// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Doubles decide on which sides of each other the ends of most arcs are, and exact predicates all
// others.
#include "arrangement/side_meeting.h"

#include "arrangement/directions.h"
#include "arrangement/sided_arc.h"
#include "rondel/predicates.h"

namespace rondel::arrangement {
namespace {

// One of the arcs, and which ends of the other one are ends of it, too.
class MetArc {
 public:
  MetArc(std::span<const Point> points, Index from, Index to)
      : points_(points), from_(from), to_(to), arc_(points[from], points[to]) {}

  [[nodiscard]] bool has_end(Index node) const { return node == from_ || node == to_; }
  // Returns on which side of the great circle a node is, positive to the left.
  [[nodiscard]] int side(Index node) const {
    if (has_end(node)) return 0;
    const int sure = arc_.side(points_[node]);
    return sure != 0 ? sure
                     : static_cast<int>(orientation(points_[from_], points_[to_], points_[node]));
  }
  // True if the node is in the inside of the arc, on whose great circle it is.
  [[nodiscard]] bool has_inside(Index node) const {
    return !has_end(node) && is_between(points_[from_], points_[to_], points_[node]);
  }

 private:
  std::span<const Point> points_;
  Index from_;
  Index to_;
  SidedArc arc_;
};

}  // namespace

// Two arcs on different great circles meet once at most. Where each circle separates the ends of the
// other arc, they cross, or one crosses the antipodes of the other one (do_arcs_cross()).
SideMeeting meeting_of(std::span<const Point> points, Index a, Index b, Index c, Index d) {
  SideMeeting meeting;
  const MetArc first(points, a, b);
  for (const Index node : {c, d}) {
    if (first.has_end(node)) meeting.add(node);
  }
  if (meeting.num_nodes == 2) return meeting;
  const int of_c = first.side(c);
  const int of_d = first.side(d);
  if (of_c * of_d > 0 || (meeting.num_nodes == 1 && (of_c != 0 || of_d != 0))) return meeting;
  if (of_c == 0 && first.has_inside(c)) meeting.add(c);
  if (of_d == 0 && first.has_inside(d)) meeting.add(d);
  const MetArc second(points, c, d);
  const int of_a = second.side(a);
  const int of_b = second.side(b);
  if (of_a == 0 && second.has_inside(a)) meeting.add(a);
  if (of_b == 0 && second.has_inside(b)) meeting.add(b);
  meeting.is_crossing = of_c != 0 && of_d == -of_c && of_a == -of_c && of_b == of_c;
  return meeting;
}

}  // namespace rondel::arrangement
