// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides that are straight in longitude and latitude as arcs of great circles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/plane_sweep.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The positions of a straight line so near to each other that arcs between them are within the tolerance (radians) of
// it: the first one, and those between, without the last one. The same both ways.
void append_divided(const LonLat& from, const LonLat& to, double tolerance,
                    std::vector<LonLat>& positions);

// The corners of sides as arcs.
struct DividedSides {
  std::vector<LonLat> positions;
  std::vector<std::uint64_t> offsets = {0};  // of each side; its positions, without the last one
};

// A part of a side, which has a number; it goes from west to east.
struct LinePiece {
  Index side;
  LonLat west;
  LonLat east;
};

// Divides sides, first by append_divided(), and further until arcs lie to each other as the straight lines do
// (docs/theory/polygons.md): where one comes nearer to a corner than its arc may be from it, it gets a corner on that meridian.
class SideDivider {
 public:
  SideDivider(std::span<const PlaneSide> sides, double tolerance, unsigned threads);

  // Halves all parts of side s so many times as times[s] says, and divides sides further for that. Returns the sides that have
  // changed, in order.
  std::vector<Index> halve(std::span<const std::uint8_t> times);

  [[nodiscard]] DividedSides divided();

 private:
  void match(std::vector<LonLat> added, bool are_few);

  std::span<const PlaneSide> sides_;
  unsigned threads_;
  std::vector<LinePiece> pieces_;
  std::vector<Index> changed_;  // sides, some of them twice
};

}  // namespace rondel::overlay
