// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A polygon that is asked many times which places it has, and where it meets others.
//
// in    the rings of a cell, between numbered nodes
// out   its sides, which meet in nodes at most, in a tree of boxes; what is connected of them; boxes
//       that contain its interior
// index nodes: along the spatial order; sides; components: sets of sides that hang together
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "arrangement/box_tree.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A side of a polygon, whose interior is to the left.
struct PolygonSide {
  Index from;
  Index to;
};

// A side as seen from one of its nodes, or from a node in its inside.
struct SideDirection {
  Index target;  // the end to which the direction leads
  bool is_out;   // whether the side runs in this direction, so that the interior is to the left
};

// Returns the last direction before that to a target, counterclockwise around a node; a direction to
// the target is before it if `is_along_before`. There must be one.
const SideDirection& direction_before(std::span<const Point> points, Index node,
                                      const Point& target,
                                      std::span<const SideDirection> directions,
                                      bool is_along_before);

// What is wrong with a polygon.
enum class PolygonFault : std::uint8_t {
  none,
  crossing_sides,
  disagreeing_sides,  // sides do not agree on where the interior is
  no_sides            // all sides cancel each other, or it is whole and has rings
};

class PreparedPolygon {
 public:
  // Makes the empty polygon.
  PreparedPolygon() = default;
  // `points` has the places of the nodes, and stays valid; `numbers` has the node of each corner's
  // point. A polygon with a fault has no sides.
  PreparedPolygon(const CellRings& cells, std::size_t cell, std::span<const Point> points,
                  std::span<const Index> numbers);

  [[nodiscard]] PolygonFault fault() const { return fault_; }
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  [[nodiscard]] bool is_empty() const { return sides_.empty() && !is_whole_; }
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
  // A box that contains the polygon, with its interior.
  [[nodiscard]] const SpaceBox& extent() const { return extent_; }
  // True if a place that is not on a side is in the interior.
  [[nodiscard]] bool has(const Point& place) const;

 private:
  void append_sides(const CellRings& cells, std::size_t cell, std::span<const Index> numbers);
  void make_boxes();
  void divide_sides();
  void cancel_sides();
  void find_components();
  [[nodiscard]] bool do_components_agree() const;
  void find_extent();
  // What a path from a place or a node to a node meets.
  struct Path {
    std::vector<SideDirection> at_start;
    std::vector<SideDirection> at_end;
    bool is_odd = false;  // whether it crosses an odd number of sides
  };
  [[nodiscard]] Path path(const Point& from, Index start, Index end) const;

  std::span<const Point> points_;
  std::vector<PolygonSide> sides_;
  std::vector<Index> components_;   // of each side
  std::vector<Index> first_sides_;  // of each component
  BoxTree boxes_{{}, 1};
  BoxTree component_boxes_{{}, 1};
  SpaceBox extent_ = empty_box;
  PolygonFault fault_ = PolygonFault::none;
  bool is_whole_ = false;
};

}  // namespace rondel::arrangement
