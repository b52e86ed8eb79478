// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The relation of two polygons.
//
// in    prepared polygons, with the same nodes
// out   the matrix of their relation
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "arrangement/pair_meetings.h"
#include "arrangement/prepared_polygon.h"
#include "rondel/relate.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// What occurs of two polygons A and B.
struct SideFacts {
  std::array<bool, 2> are_inside{};   // sides of A in the interior of B; of B in that of A
  std::array<bool, 2> are_outside{};  // sides of A in the exterior of B; of B in that of A
  bool are_along = false;             // sides of both along each other, interiors on the same side
  bool are_against = false;           // the same, interiors on different sides
  bool do_meet = false;               // places on the sides of both
};

// Relates polygons, one pair after the other.
class PairRelater {
 public:
  // `points` has the places of the nodes.
  explicit PairRelater(std::span<const Point> points) : meetings_(points) {}

  Relation operator()(const PreparedPolygon& a, const PreparedPolygon& b);
  // Returns the relation of a polygon to itself.
  static Relation of_itself(const PreparedPolygon& polygon);

 private:
  void look_along(Index node, const SideDirection& direction, std::span<const SideDirection> others,
                  std::size_t k);
  void locate_components(std::size_t k);

  PairMeetings meetings_;
  std::array<const PreparedPolygon*, 2> polygons_{};
  SideFacts facts_;
};

}  // namespace rondel::arrangement
