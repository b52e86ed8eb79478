// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Dimensions 0 and 1: all sites lie in one plane through the center.
#pragma once

#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::kernel {

// Positions of points that span the most: three that are not in one plane with the center; if there
// are none, two that are not in line with it; if there are none either, one.
RONDEL_API std::vector<Index> find_span(std::span<const Point> points, const Point& center);

// For points in one plane through the center: the positions of the vertices around
// the circle, starting with the lowest, counterclockwise seen from the side to which the plane's
// normal points, its first non-zero coordinate being positive.
//
// Model::projected: all of them. Model::weighted: the corners of the convex polygon, ties being
// broken by raising the points as in dimension 2; a point between two others
// in line with the center is hidden. `span` comes from find_span.
std::vector<Index> ring_of_great_circle(std::span<const Point> points, std::span<const Index> span,
                                        Model model, const Point& center);

}  // namespace rondel::kernel
