// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of order 2.
#pragma once

#include <span>

#include "overlay/slopes_of_cells.h"
#include "rondel/remap.h"
#include "rondel/weights.h"

namespace rondel::overlay {

// Of the pieces of a remapping, with their moments, and divided by `target_areas`. Targets come in the order of
// `targets`, which is spatial or empty: what is near on the sphere is near in time then.
Weights linear_weights(const Remap& remap, const CellGradients& gradients,
                       std::span<const double> target_areas, std::span<const Index> targets,
                       unsigned threads);

}  // namespace rondel::overlay
