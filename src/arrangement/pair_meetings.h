// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the sides of two geometries meet: polygons or lines.
//
// in    prepared sides of both, with the same nodes
// out   nodes where they meet, with the sides there; whether sides cross where no node is; which
//       sides overlap
// index nodes; parts: 0 is the first geometry, 1 the second one
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "arrangement/prepared_sides.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A side that has a node where sides of both parts meet, at an end or in its inside.
struct Incidence {
  Index node;
  Index part;
  Index side;
  friend auto operator<=>(const Incidence&, const Incidence&) = default;
};

class PairMeetings {
 public:
  // `points` has the places of the nodes.
  explicit PairMeetings(std::span<const Point> points) : points_(points) {}

  // Finds where two geometries meet. They must live as long as they are asked for.
  void find(const PreparedSides& first, const PreparedSides& second);

  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] const PreparedSides& part(std::size_t k) const { return *parts_[k]; }
  [[nodiscard]] const PolygonSide& side(const Incidence& i) const {
    return parts_[i.part]->sides()[i.side];
  }
  // Sorted by nodes.
  [[nodiscard]] std::span<const Incidence> incidences() const { return incidences_; }
  // True if sides cross in the inside of both, where no node is.
  [[nodiscard]] bool has_crossings() const { return has_crossings_; }
  // True if a side has more than a place in common with one of the other part.
  [[nodiscard]] bool has_overlaps() const { return !overlaps_.empty(); }
  // True if each place of the sides of a part is on sides of the other one.
  [[nodiscard]] bool is_covered(std::size_t k);
  // Returns the components of a part that have incidences, sorted.
  [[nodiscard]] std::span<const Index> met_components(std::size_t k);

  // Calls visit(node, directions) for each node, with the directions of the sides of both parts
  // from it.
  template <class Visit>
  void visit_nodes(const Visit& visit) {
    for (std::size_t begin = 0; begin < incidences_.size();) {
      const Index node = incidences_[begin].node;
      for (auto& directions : directions_) directions.clear();
      std::size_t end = begin;
      for (; end < incidences_.size() && incidences_[end].node == node; ++end) {
        const PolygonSide& at_node = side(incidences_[end]);
        std::vector<SideDirection>& directions = directions_[incidences_[end].part];
        if (at_node.from != node) directions.push_back({at_node.from, false});
        if (at_node.to != node) directions.push_back({at_node.to, true});
      }
      visit(node, directions_);
      begin = end;
    }
  }

 private:
  // A stretch that a side of each part has, between two nodes.
  struct Stretch {
    std::array<Index, 2> sides;
    std::array<Index, 2> nodes;
  };

  void meet(Index k, Index s, Index t);

  std::span<const Point> points_;
  std::array<const PreparedSides*, 2> parts_{};
  std::vector<Incidence> incidences_;
  std::vector<Stretch> overlaps_;
  bool has_crossings_ = false;
  std::array<std::vector<SideDirection>, 2> directions_;  // of each part, from a node
  std::vector<Index> met_;
};

// The place of a side of one part, seen from a node.
enum class SidePlace : char { inside, outside, along, against };

// Returns where a side in this direction from a node runs, as seen by the sides of a polygon there.
// Along: with the interior on the same side, if the side is one of a polygon.
SidePlace place_of_side(std::span<const Point> points, Index node, const SideDirection& direction,
                        std::span<const SideDirection> of_polygon);

}  // namespace rondel::arrangement
