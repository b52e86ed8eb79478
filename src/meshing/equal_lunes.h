// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of sites on a great circle. Their power cells are lunes between the two poles of the
// circle, and the hull of the weighted sites w_i q_i is a polygon in the plane of the circle: the
// lune of site i lies between the normals of the polygon's sides before and after it, and its area
// is twice the angle between them. With the sites in order, at angles f_i, and with given areas,
// the normal of the side from i to i + 1 is at p_i = p_0 + (the angles of the lunes 1 ... i), and
//
//     w_{i+1} / w_i = cos(p_i - f_i) / cos(p_i - f_{i+1}),
//
// where both cosines are positive, or both are negative if the sites are more than 180 degrees
// apart, which happens at most once. The only unknown is p_0: the product of all these quotients
// must be 1.
//
// 1. If no two neighbors are more than 180 degrees apart, the product falls from infinity to 0
//    between the least and the largest p_0 that have these signs, since tan(p - f) falls as f
//    grows. There is one solution if there is such a p_0, and otherwise none.
// 2. If two neighbors are exactly opposite to each other, the side between them passes through the
//    center: this determines p_0, and the quotient is free.
// 3. Otherwise all sites lie on less than half of the circle, and some sites of the polygon may be
//    on its side towards the center, so that its sides need not join neighbors. Only polygons with
//    one such side, the last one, are searched. The product may tend to infinity, or to 0, at both
//    ends; then the solution is searched in 4096 intervals, and there may be two.
//
// in    unit vectors on a great circle, areas
// out   the length of each weighted site
// index sites
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::mesh {

// True if the unit vectors lie on one great circle up to rounding; two always do.
bool lie_on_great_circle(std::span<const Point> units);

// The weights of sites on a great circle, by site.
struct LuneWeights {
  std::vector<double> lengths;  // the least is 1; empty if no solution is found
  bool are_all_tried = true;    // false if there may be other solutions, by 3
};

// Returns the lengths of the weighted sites whose lunes have these areas, which add up to 4 pi.
// Precondition: three distinct unit vectors or more that lie on a great circle.
LuneWeights lune_weights(std::span<const Point> units, std::span<const double> areas);

}  // namespace rondel::mesh
