// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Spacings that grow slowly: h(x) <= h(y) + slope |x - y|.
#pragma once

#include <vector>

#include "meshing/size_raster.h"

namespace rondel::mesh {

// Lowers values at the nodes until none is more than that of another, a few steps away, and the slope
// times their distance.
void limit_slope(const CubeRaster& cube, double slope, std::vector<double>& values);

}  // namespace rondel::mesh
