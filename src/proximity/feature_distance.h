// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The distance from points of features to the nearest site of any other feature.
//
// in    sites and query points, unit vectors, each with the index of its feature
// out   a distance for each query, radians
// index features; any number may be one, they need not be consecutive
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::proximity {

// Sites with the index of the feature that each belongs to: two arrays of equal length.
struct LabelledSites {
  std::span<const Point> sites;
  std::span<const Index> features;
};

// Returns for each query the distance in radians to the nearest site whose feature is not
// features[query], or infinity if all sites belong to that feature.
std::vector<double> distances_to_others(const LabelledSites& labelled,
                                        std::span<const Point> queries,
                                        std::span<const Index> features,
                                        const Execution& execution);

}  // namespace rondel::proximity
