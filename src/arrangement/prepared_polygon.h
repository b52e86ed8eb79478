// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A polygon that is asked many times which places it has, and where it meets others.
//
// in    the rings of a cell, between numbered nodes
// out   its sides, which meet in nodes at most; a box that contains its interior
// index nodes, sides and components of PreparedSides
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "arrangement/prepared_sides.h"
#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Returns the last direction before that to a target, counterclockwise around a node; a direction
// to the target is before it if `is_along_before`. There must be one.
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

class PreparedPolygon : public PreparedSides {
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
  // True if a place that is not on a side is in the interior.
  [[nodiscard]] bool has(const Point& place) const;

 private:
  void append_sides(const CellRings& cells, std::size_t cell, std::span<const Index> numbers);
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

  PolygonFault fault_ = PolygonFault::none;
  bool is_whole_ = false;
};

}  // namespace rondel::arrangement
