// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The circumscribed circles of the faces of a triangulation, and which faces have the same circle.
//
// in    an unweighted triangulation
// out   a center, a radius and a representative for each face
// index faces, ghost faces included
#pragma once

#include <vector>

#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::proximity {

struct FaceCircles {
  std::vector<Index> first_face;  // the lowest face with exactly the same circle and center
  std::vector<Point> centers;     // unit vectors
  std::vector<double> radii;      // radians; exact to some ulp where first_face[f] == f
};

// Precondition: Model::projected.
FaceCircles face_circles(const Triangulation& triangulation, const Execution& execution);

}  // namespace rondel::proximity
