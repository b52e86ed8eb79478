// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Computes the weights of conservative remapping of order 2.
#pragma once

#include <span>

#include "overlay/slopes_of_cells.h"
#include "rondel/remap.h"
#include "rondel/weights.h"

namespace rondel::overlay {

// Returns the weights of a remapping with moments, divided by `target_areas`. `gradients` belong to
// the sources. The targets are computed in the order of `targets`, which is a spatial order, or in
// their own order if it is empty; the result does not depend on it.
Weights linear_weights(const Remap& remap, const CellGradients& gradients,
                       std::span<const double> target_areas, std::span<const Index> targets,
                       unsigned threads);

}  // namespace rondel::overlay
