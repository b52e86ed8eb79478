// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The slow path of the dual: normals and differences from exact integers, rounded once.
#pragma once

#include <array>

#include "dual/split_sites.h"
#include "rondel/export.h"

namespace rondel::dual {

struct ExactNormal {
  Point normal;
  bool is_degenerate;  // the three corners are collinear (weighted model only)
};

// The outward unit normal of the face (a, b, c), each coordinate within 2^-53.
//
// Collinear corners span a face only after the perturbation, which raises sites from the
// center: the face then lies in the plane through the center (or, when that is on the
// line too, through the first site that is not), which supports the hull. Its normal
// points away from the sites.
RONDEL_API ExactNormal exact_normal(const SplitSites& sites, Index a, Index b, Index c);

// The difference b/|b| - a/|a| of the projections.
struct ExactDifference {
  Vec direction;  // unit vector, each coordinate within 2^-53
  double length;  // 0 where it is below the smallest double
};
RONDEL_API ExactDifference exact_projected_difference(const Point& a, const Point& b,
                                                      const Point& center);

// The weights, of sum 1, for which the weighted sum of the projections of the corners lies on the ray
// of p, which is within their cone: each within 2^-53 of itself.
RONDEL_API std::array<double, 3> exact_weights(const std::array<Point, 3>& corners, const Point& p,
                                               const Point& center);

// The unit vector from a to b.
Vec exact_direction(const Point& a, const Point& b);

}  // namespace rondel::dual
