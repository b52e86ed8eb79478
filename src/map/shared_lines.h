// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How lines of a map are divided and positions of it merged: for all regions at once, so that those on both sides of a
// line get the same positions, bit by bit.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "map/map_plane.h"
#include "map/planar_loops.h"
#include "rondel/types.h"

namespace rondel::map {

class SharedLines {
 public:
  [[nodiscard]] bool is_empty() const { return divisions_.empty() && merged_.empty(); }

  // Where a position is now.
  [[nodiscard]] LonLat place(LonLat position) const;

  // Whether the line is drawn as it is.
  [[nodiscard]] bool is_current(const LonLat& a, const LonLat& b) const;

  // Gives a line a position between its ends; false if it has one, or that is one of its ends.
  bool divide(const LonLat& a, const LonLat& b, const LonLat& at);

  // Makes two positions one; false if they are.
  bool merge(const LonLat& a, const LonLat& b);

  // The sides of a loop as they are now.
  void append_sides(const Loop& loop, std::vector<DirectedLine>& out) const;

 private:
  using Ends = std::pair<LonLat, LonLat>;
  struct EndsInPlane {
    bool operator()(const Ends& x, const Ends& y) const {
      return x.first == y.first ? InPlane()(x.second, y.second) : InPlane()(x.first, y.first);
    }
  };

  // The divided lines on the way to a part of one.
  struct Descent {
    std::vector<Ends> path;
    int budget = 1 << 12;
  };

  [[nodiscard]] std::optional<LonLat> division_of(const LonLat& a, const LonLat& b) const;
  // Whether the line would be a part of itself, divided there.
  [[nodiscard]] bool leads_back(const LonLat& a, const LonLat& b, const LonLat& position) const;
  void append_line(const LonLat& a, const LonLat& b, Descent& descent,
                   std::vector<DirectedLine>& out) const;

  std::map<Ends, LonLat, EndsInPlane> divisions_;  // of lines, their lower end first
  std::map<LonLat, LonLat, InPlane> merged_;
};

}  // namespace rondel::map
