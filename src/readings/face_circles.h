// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The circles around the faces.
#pragma once

#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::readings {

struct FaceCircles {
  std::vector<Index> first_face;  // of the faces with the circle of this face, exactly
  std::vector<Point> centers;     // of each face: unit vectors
  std::vector<double> radii;      // of each face that is its own first one: radians
};

// Precondition: Model::projected.
FaceCircles face_circles(const Triangulation& triangulation, const Execution& execution);

}  // namespace rondel::readings
