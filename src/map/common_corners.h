// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes neighboring regions have the same corners on their common border: where one of them has a
// corner on an arc of the other, the other gets the corner too.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::map {

// The corners of rings that lie on arcs of other rings. Arcs that two rings have in common in
// opposite directions need no corners, so only the other arcs are compared. `points` are the
// merged_points() of the cells; they stand in for cells.points.
class CommonCorners {
 public:
  CommonCorners(const CellRings& cells, std::span<const Point> points, unsigned threads);

  // Appends the points of a ring to `out`, and after each the corners of other rings within
  // merge_distance of the arc that begins there. `corners` are indices into `points`.
  void append_ring(std::span<const Index> corners, std::span<const Point> points,
                   std::vector<Point>& out) const;

 private:
  // A directed arc of a ring.
  struct RingArc {
    Point from;
    Point to;
    friend bool operator==(const RingArc&, const RingArc&) = default;
  };
  // Orders arcs lexicographically by the coordinates of their ends.
  struct ArcsInSpace {
    bool operator()(const RingArc& a, const RingArc& b) const;
  };
  struct ArcBox;
  class ArcBoxes;

  static std::vector<RingArc> unmatched_arcs(const CellRings& cells, std::span<const Point> points,
                                             unsigned threads);
  static void sort_along_curve(std::vector<RingArc>& arcs, unsigned threads);

  // The corners on an arc, from its beginning on.
  std::map<RingArc, std::vector<Point>, ArcsInSpace> inner_;
};

}  // namespace rondel::map
