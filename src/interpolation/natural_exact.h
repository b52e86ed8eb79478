// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Natural neighbor weights in arbitrary precision, for targets where fixed precision does not
// suffice.
//
// in    the target, its natural neighbors in ring order, the faces of its conflict region
// out   a weight for each neighbor
// index positions in the ring of neighbors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/natural_region.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The methods, by the weight that they give to a neighbor before the weights are divided by their
// sum.
enum class NaturalMethod : std::uint8_t {
  laplace,        // side of the new cell over the distance, in the gnomonic plane of u
  sibson,         // stolen area, in the gnomonic plane of u
  planar_sibson,  // stolen area, in the stereographic plane of u (projection from -u)
};

// Computes the weights of `sites`, the natural neighbors of the target in ring order, with a
// relative error of at most 2^-50. `faces` are those of the conflict region (natural_region.h).
// Returns false if several thousand bits do not decide whether the cell of the target is bounded.
bool exact_natural_weights(NaturalMethod method, const Point& target, std::span<const Point> sites,
                           const Point& center, std::span<const RegionFace> faces,
                           std::vector<double>& weights);

}  // namespace rondel::interpolation
