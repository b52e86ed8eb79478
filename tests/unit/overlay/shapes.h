// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hostile regions as rings of points, of some of which only an oracle knows whether they bound anything.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/types.h"

namespace rondel::test {

using RingOfPoints = std::vector<Point>;

inline constexpr std::array<const char*, 15> shape_kinds = {
    "sliver",       "folded", "bow_tie", "bow_tie_with_a_corner",
    "keyhole",      "spike",  "islands", "world_less_islands",
    "lagoon",       "belt",   "octant",  "pole",
    "antimeridian", "cap",    "tangle"};

// Some corners of some shapes are among `corners`, those of what they are laid over.
std::vector<RingOfPoints> hostile_shape(std::size_t kind, std::uint64_t seed,
                                        std::span<const Point> corners);

// One cell of these rings, each corner a point of its own.
CellRings one_cell_of(const std::vector<RingOfPoints>& rings);
// A cell for each ring, each corner a point of its own.
CellRings cells_of_rings(const std::vector<RingOfPoints>& rings);

// A ring of a cell, by longitudes and latitudes.
struct RingOfPart {
  std::vector<LonLat> corners;
};
// Each cell by its rings; equal corners are one point.
CellRings cells_of_parts(const std::vector<std::vector<RingOfPart>>& cells);

}  // namespace rondel::test
