// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the ray of a point leaves the cube around the sphere.
#pragma once

#include "blocks/hilbert.h"
#include "rondel/types.h"

namespace rondel::blocks {

// From differences rounded to doubles. Depends on the ray alone when the center is (0, 0, 0):
// the quotients of two coordinates are rounded correctly, so points on one ray agree.
CubePosition cube_position(const Point& p, const Point& center);

// From exact differences: depends on the exact ray alone for every center.
CubePosition exact_cube_position(const Point& p, const Point& center);

}  // namespace rondel::blocks
