// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Approximates sides that are straight in longitude and latitude by arcs of great circles.
//
// in    straight sides in degrees, a tolerance in radians
// out   positions that divide each side
// index sides, in the order in which they are given
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/plane_sweep.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Appends positions of a straight line that are so near to each other that the arcs between them
// are within the tolerance (radians) of the line: the first one and those between, without the last
// one. The reversed line gets the same positions.
void append_divided(const LonLat& from, const LonLat& to, double tolerance,
                    std::vector<LonLat>& positions);

// The corners of sides as arcs: a row has those of a side without the last one.
using DividedSides = CompressedRows<LonLat>;

// A part of a side, from west to east.
struct LinePiece {
  Index side;
  LonLat west;
  LonLat east;
};

// Divides sides by append_divided(), and then further until the arcs have the same order and the
// same crossings as the straight lines (docs/theory/polygons.md): a side that comes nearer to a
// corner than its arc may be from the side gets a corner on the meridian of that corner.
class SideDivider {
 public:
  // The first sides are those of closed rings: each of them ends where another one begins.
  SideDivider(std::span<const PlaneSide> sides, std::size_t num_closed, double tolerance,
              unsigned threads);

  // Halves all parts of each side s times[s] times, and divides sides further where this requires
  // it. Returns the sides that have changed, in order.
  std::vector<Index> halve(std::span<const std::uint8_t> times);

  // Returns the corners of all divided sides.
  [[nodiscard]] DividedSides divided();

 private:
  void match(std::vector<LonLat> added);
  template <class Along>
  void sort_pieces(const Along& along);

  std::span<const PlaneSide> sides_;
  unsigned threads_;
  std::vector<LinePiece> pieces_;
  std::vector<Index> changed_;  // changed sides, possibly twice
};

// An arc to a pole is on the meridian of its other end, so arcs of different lines to a pole lie on
// each other if their last corners have one longitude. Inserts into each such arc the corners of
// other sides that are on it, so that the arcs are equal and not only equal up to rounding.
void share_polar_corners(std::span<const PlaneSide> sides, DividedSides& divided);

}  // namespace rondel::overlay
