// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which of many sites need not be inserted because they lie deep inside the hull of others.
//
//        .-------.         1. Of the sites in each square of a grid of directions the farthest is
//      / . * .  .  \          a candidate (*); the candidates' hull is built.
//     *  .  o . .   *      2. Its gauge g, the function with g = 1 on its boundary and
//      \  .   . .  /          g(tx) = t g(x), is convex. So on a square of the cube the bilinear
//        '--*----'            interpolation of values at its corners is an upper bound.
//                          3. A site whose bound is below 1 by more than the errors is inside.
//
// The test may fail to notice that a site is inside, never the converse: the hull of all sites is
// that of the rest. docs/theory/hull.md has the proof and the count of errors.
#pragma once

#include <span>
#include <vector>

#include "hidden/inner_point.h"
#include "rondel/types.h"

namespace rondel::hidden {

// The sites that remain when some are left out that are strictly inside the hull of the remaining
// ones; in increasing order. Sites in one place remain together or are left out together. `inner`
// is inside (is_inside).
std::vector<Index> rest_without_inner_sites(std::span<const Point> sites, const InnerPoint& inner);

// Whether a sample of the sites lets expect that many are inside.
bool has_many_inner_sites(std::span<const Point> sites, const Point& center);

}  // namespace rondel::hidden
