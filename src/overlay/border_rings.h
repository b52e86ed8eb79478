// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Joins arcs in any order into rings.
//
// in    arcs, each with the key of the region to its left
// out   the rings of each region
// index keys, from 0: the cells of the result
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::overlay {

// An arc of a great circle with a region to its left.
struct KeyedArc {
  Index key;  // the region
  Point from;
  Point to;
};

// An arc whose ends are indices of points.
struct KeyedSide {
  Index key;
  Index from;
  Index to;
};

// Returns cells of which cell i has the rings around the region with the key i.
//
// 1. Arcs of one region that lead back and forth between two points cancel, so that parts that
//    touch there are joined.
// 2. Where rings of a region meet in a point, each of them bounds one part of the region there.
// 3. A ring begins at its corner with the least coordinates, rings are sorted by these corners, and
//    points by their coordinates. So the result does not depend on the order of the arcs.
// 4. Rings no larger than what rounding of their corners can make are dropped.
//
// Throws InvalidInput if the arcs of a region do not form closed rings and are wider than rounding.
CellRings rings_around(std::span<const KeyedArc> arcs, std::size_t num_keys, unsigned threads);
// Returns the same for sides between points, of which several may be equal.
CellRings rings_around(std::span<const Point> points, std::span<const KeyedSide> sides,
                       std::size_t num_keys, unsigned threads);

// True if a ring is no larger than what rounding can make. A ring that rounding has turned clockwise
// is no hole: alone it would be the border of nearly the whole sphere. Its corners are crossings of
// sides that themselves end in crossings, so it may be wider than a counterclockwise ring.
bool is_rounding(std::span<const Point> ring);

// True if between any two points as many arcs lead back as forth, so that the arcs bound no region.
bool is_nothing(std::span<const KeyedArc> arcs);

// Knows of arcs that are added one after the other, without keeping them, that they bound a region.
class ArcBalance {
 public:
  void add(std::span<const KeyedArc> arcs);
  // False if is_nothing() is certainly false for all arcs. It is true by chance hardly ever.
  [[nodiscard]] bool may_be_nothing() const { return sum_ == 0; }

 private:
  std::uint64_t sum_ = 0;  // of hashes of arcs, less those of the arcs back
};

}  // namespace rondel::overlay
