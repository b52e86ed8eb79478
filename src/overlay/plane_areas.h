// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides the sides of cells that are straight in longitude and latitude until arcs preserve the
// cells' areas.
//
// in    straight sides in degrees, each with its cell, a tolerance in radians
// out   positions that divide each side
// index sides, in the order in which they are given; cells
#pragma once

#include <algorithm>
#include <numbers>
#include <span>

#include "overlay/plane_arcs.h"
#include "overlay/plane_sweep.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The largest share of a cell's area by which arcs may change it. If arcs may be `tolerance`
// radians from their lines, it is the share for a cell that is a tenth of a degree wide and lies
// along such arcs, at most max_area_share.
constexpr double max_area_share = 1e-3;
constexpr double area_share(double tolerance) {
  constexpr double tenth_of_degree = std::numbers::pi / 1800;
  return std::min(max_area_share, tolerance / tenth_of_degree);
}

// Divides the sides until the area of each cell differs from the area between its straight lines by
// no more than `area_share` of it and rounding of its corners. owners[s] is the cell of side s; the
// sides of a cell follow each other, and are its whole border. Sides without an owner come last: they
// bound no cell. Sides in the same place are divided alike.
DividedSides divide_for_areas(std::span<const PlaneSide> sides, std::span<const Index> owners,
                              double tolerance, unsigned threads);

}  // namespace rondel::overlay
