// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The relation of points or lines to points, lines or a polygon.
//
// in    prepared geometries, with the same nodes; points are nodes, sorted, each once
// out   the matrix of their relation
// index nodes
#pragma once

#include <span>

#include "arrangement/pair_meetings.h"
#include "arrangement/prepared_lines.h"
#include "arrangement/prepared_polygon.h"
#include "rondel/relate.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// The nodes of points.
using PointNodes = std::span<const Index>;

// Relates points and lines, one pair after the other.
class LineRelater {
 public:
  // `points` has the places of the nodes.
  explicit LineRelater(std::span<const Point> points) : meetings_(points) {}

  [[nodiscard]] static Relation relate(PointNodes a, PointNodes b);
  [[nodiscard]] static Relation relate(PointNodes a, const PreparedLines& b);
  [[nodiscard]] Relation relate(PointNodes a, const PreparedPolygon& b) const;
  [[nodiscard]] Relation relate(const PreparedLines& a, const PreparedLines& b);
  [[nodiscard]] Relation relate(const PreparedLines& a, const PreparedPolygon& b);

 private:
  PairMeetings meetings_;
};

}  // namespace rondel::arrangement
