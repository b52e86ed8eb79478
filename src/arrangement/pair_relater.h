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
#include <vector>

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
  explicit PairRelater(std::span<const Point> points) : points_(points) {}

  Relation operator()(const PreparedPolygon& a, const PreparedPolygon& b);
  // Returns the relation of a polygon to itself.
  static Relation of_itself(const PreparedPolygon& polygon);

 private:
  // A side that has a node where sides of both polygons meet, at an end or in its inside.
  struct Incidence {
    Index node;
    Index polygon;  // 0: of A; 1: of B
    Index side;
    friend auto operator<=>(const Incidence&, const Incidence&) = default;
  };

  [[nodiscard]] const PolygonSide& side(const Incidence& i) const {
    return polygons_[i.polygon]->sides()[i.side];
  }
  void find_meetings();
  void meet(Index k, Index s, Index t);
  void look_around_nodes();
  void look_along(Index node, const SideDirection& direction, std::size_t k);
  void locate_components(std::size_t k);

  std::span<const Point> points_;
  std::array<const PreparedPolygon*, 2> polygons_{};
  SideFacts facts_;
  std::vector<Incidence> incidences_;                     // sorted
  std::array<std::vector<SideDirection>, 2> directions_;  // of each polygon, from a node
  std::vector<Index> met_;  // components of a polygon that meet the other one, sorted
};

}  // namespace rondel::arrangement
