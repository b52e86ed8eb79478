// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Limits how fast spacings grow: h(x) <= h(y) + slope |x - y|.
//
// in    a raster of the cube, its values, a slope (spacing per distance)
// out   the largest values that are not larger and fulfill the limit, nearly
// index nodes of the raster (size_raster.h)
#pragma once

#include <vector>

#include "meshing/size_raster.h"

namespace rondel::mesh {

// Lowers the values at the nodes until none exceeds that of a node a few steps away by more than
// the slope times their distance.
void limit_slope(const CubeRaster& cube, double slope, std::vector<double>& values);

}  // namespace rondel::mesh
