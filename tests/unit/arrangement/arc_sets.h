// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Named sets of arcs, plain and hostile, with random numbers from a seed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {

struct ArcSet {
  std::vector<Point> points;
  std::vector<std::array<Index, 2>> arcs;

  void add(const Point& from, const Point& to);
};

// The kinds of sets:
//   sphere        ends anywhere
//   cap           ends within 1e-3 of a place
//   ulps          ends within 1e-15 of a place
//   grid          ends in 124 directions with small integers, among them equal ones
//   same_circle   arcs along one great circle up to rounding, which overlap
//   pencil        arcs through one place up to rounding
//   needles       long arcs from a few places an ulp apart
//   at_axis       ends within a few 1e-16 of an axis, on a grid
//   near_axis     ends within a few 1e-40 of an axis, on a grid
//   two_scales    ends within 1e-20 of an axis, on a grid or an ulp away from it
//   ulp_grid      ends on a square grid of neighbouring doubles near an axis
//   nearly_half   arcs of nearly 180 degrees between two places up to rounding, and others
std::vector<std::string> kinds_of_arc_sets();
ArcSet arc_set(const std::string& kind, std::size_t size, std::uint64_t seed);

}  // namespace rondel::test
