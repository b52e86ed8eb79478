// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/icosahedron_faces.h"

#include "exact/vector.h"

namespace rondel::grids {

std::vector<IcosahedronFace> icosahedron_faces(const std::vector<Point>& corners) {
  std::vector<IcosahedronFace> faces;
  faces.reserve(20);
  constexpr double between_neighbors = 0.3;  // the cosine of the angle is 1 / sqrt(5)
  const auto are_near = [&](Index a, Index b) {
    return dot(corners[a], corners[b]) > between_neighbors;
  };
  for (Index a = 0; a < corners.size(); ++a) {
    for (Index b = a + 1; b < corners.size(); ++b) {
      for (Index c = b + 1; c < corners.size(); ++c) {
        if (!are_near(a, b) || !are_near(b, c) || !are_near(c, a)) continue;
        const bool is_left = dot(cross(corners[a], corners[b]), corners[c]) > 0;
        faces.push_back(is_left ? IcosahedronFace{a, b, c} : IcosahedronFace{a, c, b});
      }
    }
  }
  return faces;
}

}  // namespace rondel::grids
