// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Points on the axes through the center of the sphere: they turn questions about two
// sites into orientations of three.
#pragma once

#include <algorithm>

#include "rondel/types.h"

namespace rondel::proof {

// A point on axis 0, 1 or 2 through the center, exactly, on either side but not at the center.
inline Point axis_point(Point center, unsigned axis) {
  double& value = axis == 0 ? center.x : axis == 1 ? center.y : center.z;
  value = value >= 0 ? value - std::max(1.0, value) : value + std::max(1.0, -value);
  return center;
}

}  // namespace rondel::proof
