// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Corners on arcs of other rings: where one of two neighbors has a corner on their border, the other one gets it too.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::map {

// The corners of rings that lie on arcs of other rings; merged_points() stand in place of the rings' own points. Arcs that two
// rings have in common, in opposite directions, need no corners: only the other ones are compared.
class CommonCorners {
 public:
  CommonCorners(const CellRings& cells, std::span<const Point> points, unsigned threads);

  // Appends a ring with the corners within merge_distance of its arcs.
  void append_ring(std::span<const Index> corners, std::span<const Point> points,
                   std::vector<Point>& out) const;

 private:
  struct RingArc {
    Point from;
    Point to;
    friend bool operator==(const RingArc&, const RingArc&) = default;
  };
  struct ArcsInSpace {
    bool operator()(const RingArc& a, const RingArc& b) const;
  };
  struct ArcBox;
  class ArcBoxes;

  static std::vector<RingArc> unmatched_arcs(const CellRings& cells, std::span<const Point> points,
                                             unsigned threads);
  static void sort_along_curve(std::vector<RingArc>& arcs, unsigned threads);

  std::map<RingArc, std::vector<Point>, ArcsInSpace> inner_;  // from the arc's beginning on
};

}  // namespace rondel::map
