// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loops of positions in the plane of longitude and latitude, and which of them has a hole.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::map {

using Loop = std::vector<LonLat>;  // closed, without repeating the first position at the end

// Positive if it is counterclockwise; square degrees.
double doubled_loop_area(std::span<const LonLat> loop);

// The loops between two visits of a position that have area, and what is left.
std::vector<Loop> simple_loops(const Loop& loop);

// The loops around the same region, where they touch: each keeps to one fan of it (the region is to the left), so
// that no two parts of it that touch in a position only have a loop in common. Sides in both directions go.
// Loops that touch nowhere stay as they are.
std::vector<Loop> separated_loops(std::vector<Loop> loops);

// Which of some outer rings has a hole: from the hole's point farthest in the south the first side of an
// outer ring below is one of that ring's, as outer rings are apart. The sides are listed by longitude.
class HoleOwners {
 public:
  // Precondition: there is a ring. Keeps a reference.
  explicit HoleOwners(std::span<const Loop> outer);

  [[nodiscard]] std::size_t owner_of(const Loop& hole) const;

 private:
  struct OuterSide {
    std::size_t ring = 0;
    std::size_t side = 0;
  };

  [[nodiscard]] const LonLat& begin_of(const OuterSide& side) const;
  [[nodiscard]] const LonLat& end_of(const OuterSide& side) const;
  [[nodiscard]] std::size_t list_at(double lon_deg) const;

  std::span<const Loop> outer_;
  std::vector<double> doubled_areas_;
  std::vector<std::vector<OuterSide>> lists_;  // by longitude; none if there is one ring
};

}  // namespace rondel::map
