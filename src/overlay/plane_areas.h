// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cells of straight lines in longitude and latitude, and how much their arcs add to them.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>

#include "overlay/plane_arcs.h"
#include "overlay/plane_sweep.h"
#include "rondel/types.h"

namespace rondel::overlay {

// The largest share of a cell's area by which arcs may change it, if they may be so far from their lines (radians): that of a
// cell a tenth of a degree wide along arcs as far away.
constexpr double most_area_share = 1e-3;
constexpr double area_share(double tolerance) {
  constexpr double tenth_of_degree = std::numbers::pi / 1800;
  return std::min(most_area_share, tolerance / tenth_of_degree);
}

// The sides of cells, one cell after the other, divided until the area of each cell differs from that between its lines by no more
// than `area_share` of it and by rounding of its corners. Sides in one place are divided alike.
DividedSides divide_for_areas(std::span<const PlaneSide> sides, std::span<const Index> owners,
                              double tolerance, unsigned threads);

}  // namespace rondel::overlay
