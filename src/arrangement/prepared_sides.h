// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sides of a polygon or arcs of lines that are asked many times where they meet others.
//
// in    sides between numbered nodes
// out   the sides, divided at their nodes, in a tree of boxes; what is connected of them
// index nodes: along the spatial order; sides; components: sets of sides that hang together
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "arrangement/box_tree.h"
#include "rondel/types.h"
#include "system/disjoint_sets.h"

namespace rondel::arrangement {

// A side of a polygon, whose interior is to the left; or an arc of a line, in any direction.
struct PolygonSide {
  Index from;
  Index to;
};

// A side as seen from one of its nodes, or from a node in its inside.
struct SideDirection {
  Index target;  // the end to which the direction leads
  bool is_out;   // whether the side runs in this direction, so that the interior is to the left
};

// A node that is an end of a side, or in its inside.
struct NodeOfSide {
  Index node;
  Index side;
};

class PreparedSides {
 public:
  // Makes no sides.
  PreparedSides() = default;

  [[nodiscard]] std::span<const PolygonSide> sides() const { return sides_; }
  // The boxes of the sides.
  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] std::size_t num_components() const { return first_sides_.size(); }
  [[nodiscard]] Index component(Index side) const { return components_[side]; }
  // Returns a side of a component.
  [[nodiscard]] const PolygonSide& side_of(Index component) const {
    return sides_[first_sides_[component]];
  }
  // The boxes of the components.
  [[nodiscard]] const BoxTree& component_boxes() const { return component_boxes_; }
  // A box that contains the sides, and the interior of a polygon.
  [[nodiscard]] const SpaceBox& extent() const { return extent_; }
  // True if a node is on a side or at its end.
  [[nodiscard]] bool is_on_side(Index node) const;

 protected:
  explicit PreparedSides(std::span<const Point> points) : points_(points) {}

  void make_boxes();
  // Divides sides at nodes in their inside. Returns whether sides cross; with `are_apart` nothing
  // is divided then.
  bool divide_sides(bool are_apart);
  // Leaves the sides with these numbers, which are sorted.
  void keep_sides(std::span<const Index> kept);
  // Returns the ends of all sides, sorted by nodes.
  [[nodiscard]] std::vector<NodeOfSide> sorted_ends() const;
  // Makes the components of sides that have been joined.
  void make_components(const system::DisjointSets& sets);

  std::span<const Point> points_;
  std::vector<PolygonSide> sides_;
  BoxTree boxes_{{}, 1};
  SpaceBox extent_ = empty_box;

 private:
  std::vector<Index> components_;   // of each side
  std::vector<Index> first_sides_;  // of each component
  BoxTree component_boxes_{{}, 1};
};

}  // namespace rondel::arrangement
