// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Polygons whose union is the buffer of a border, on the outside of it.
//
// in    closed loops, the outside to the right; a line is a loop there and back; a point is a loop
// out   pieces: one for each side, or one for each point
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "arrangement/offset_curves.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A loop of at least one point, of which no neighbors are on one ray.
struct BufferLoop {
  std::span<const Point> points;
  bool is_line;  // there and back: point k is point size - k
};

class BufferPieces {
 public:
  // Preconditions: 0 < tolerance <= distance / 2.
  BufferPieces(double distance, double tolerance);

  // Returns the number of pieces of a loop. Pieces in a row are near to each other.
  [[nodiscard]] std::size_t count(const BufferLoop& loop) const;
  // Returns how many pieces have to be in both of two unions of pieces in a row. Where pieces only
  // meet in a side, and each union has rounded it in its own way, there would be a gap.
  [[nodiscard]] std::size_t overlap(const BufferLoop& loop) const;
  // Appends a piece (modulo their number), as one cell or more.
  void append(const BufferLoop& loop, std::size_t number, CellRings& cells) const;

 private:
  // Which polygons make a buffer.
  enum class PieceKind : std::uint8_t {
    sides,        // distances below 90 degrees: strips along sides, and sectors at corners
    hemispheres,  // 90 degrees: what is around a corner
    disks,        // above it: what is around a corner, outside of a circle around its opposite
    everything,   // 180 degrees
  };

  // Where the strips along two consecutive sides end and begin.
  struct Joint {
    Point first_normal;
    Point second_normal;
    Point arrival;  // the last corner of the first parallel
    Point departure;
    Point inner_arrival;  // the last corner on the other side of the border
    Point inner_departure;
    bool is_shared;  // both strips have the same corners there
    bool has_turn;   // places around the corner are between the strips
    bool may_gape;   // rounding may leave a gap between them
  };
  [[nodiscard]] Joint joint(const Point& before, const Point& corner, const Point& after) const;
  void append_strip(std::span<const Point> loop, std::size_t side, CellRings& cells) const;

  PieceKind kind_;
  std::optional<OffsetCurves> curves_;
};

}  // namespace rondel::arrangement
