// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Meshes that models of atmosphere and ocean run on, from the sites of their cells (target rondel::mesh).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// The distance of neighbors where all cells are regular hexagons of this area: sqrt(2 area / sqrt 3).
RONDEL_API double spacing_of(double area);

}  // namespace rondel::mesh
