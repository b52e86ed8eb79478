// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How far places of features are from all other features.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::readings {

// Sites, and the feature of each.
struct LabelledSites {
  std::span<const Point> sites;
  std::span<const Index> features;
};

// For each query, a place of a feature: the distance to the nearest site of another one in radians; infinity where
// there is none.
std::vector<double> distances_to_others(const LabelledSites& labelled,
                                        std::span<const Point> queries,
                                        std::span<const Index> features,
                                        const Execution& execution);

}  // namespace rondel::readings
