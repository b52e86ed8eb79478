// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Records how lines of a map are divided and positions of it are merged. The records are for all
// regions at once, so that the regions on both sides of a line get the same positions, bit by bit.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "map/map_plane.h"
#include "map/planar_loops.h"
#include "rondel/types.h"

namespace rondel::map {

// The divisions and merges so far. Lines are named by their ends, in either order.
class SharedLines {
 public:
  [[nodiscard]] bool is_empty() const { return divisions_.empty() && merged_.empty(); }

  // Returns the position that a position was merged into, or the position itself.
  [[nodiscard]] LonLat place(LonLat position) const;

  // True if the line is neither divided nor has a merged end.
  [[nodiscard]] bool is_current(const LonLat& a, const LonLat& b) const;

  // Divides a line at a position. If the line would become a part of itself in this way, its nearer
  // end is merged with the position instead. Returns false, and changes nothing, if the line is not
  // current or the position is one of its ends.
  bool divide(const LonLat& a, const LonLat& b, const LonLat& at);

  // Merges two positions. Returns false, and changes nothing, if they are merged already, are far
  // apart in the plane, or are on different sides of the map's border.
  bool merge(const LonLat& a, const LonLat& b);

  // Appends the sides of a loop with all divisions and merges applied.
  void append_sides(const Loop& loop, std::vector<DirectedLine>& out) const;

 private:
  using Ends = std::pair<LonLat, LonLat>;
  struct EndsInPlane {
    bool operator()(const Ends& x, const Ends& y) const {
      return x.first == y.first ? InPlane()(x.second, y.second) : InPlane()(x.first, y.first);
    }
  };

  // The path from a line to a part of it through the divided lines between, to detect loops;
  // `budget` limits their number.
  struct Descent {
    std::vector<Ends> path;
    int budget = 1 << 12;
  };

  [[nodiscard]] std::optional<LonLat> division_of(const LonLat& a, const LonLat& b) const;
  // True if dividing the line at this position would make it a part of itself.
  [[nodiscard]] bool leads_back(const LonLat& a, const LonLat& b, const LonLat& position) const;
  void append_line(const LonLat& a, const LonLat& b, Descent& descent,
                   std::vector<DirectedLine>& out) const;

  // The division of each line, named by its ends, the lower one first.
  std::map<Ends, LonLat, EndsInPlane> divisions_;
  std::map<LonLat, LonLat, InPlane> merged_;
};

}  // namespace rondel::map
