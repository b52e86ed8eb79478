// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Parts of a mesh, which have no edge in common.
//
// in    triangles, a share of the area of the largest part
// out   which triangles are in parts that are smaller
// index triangles
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::meshing {

struct SmallParts {
  std::vector<bool> has;   // of each triangle: whether it is in one of them
  std::size_t number = 0;  // of parts
};

SmallParts small_parts(std::span<const Point> points, std::span<const Triple> triangles,
                       double share);

}  // namespace rondel::meshing
