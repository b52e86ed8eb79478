// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of natural neighbors with as many digits as it takes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/natural_region.h"
#include "rondel/types.h"

namespace rondel::interpolation {

enum class NaturalMethod : std::uint8_t {
  laplace,        // sides of the new cell over distances, in the gnomonic plane of u
  sibson,         // stolen areas, in the gnomonic plane of u
  planar_sibson,  // stolen areas, in the stereographic plane from -u
};

// The weights of `sites`, the neighbors of a target in the order of the ring; within 2^-50, whatever
// they are. False if several thousand digits do not tell whether the cell of the target is bounded.
bool exact_natural_weights(NaturalMethod method, const Point& target, std::span<const Point> sites,
                           const Point& center, std::span<const RegionFace> faces,
                           std::vector<double>& weights);

}  // namespace rondel::interpolation
