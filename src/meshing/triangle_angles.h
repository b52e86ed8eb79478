// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The angles of triangles between chords, from the squares of their sides.
//
//     cos(angle i) = (p + q - s) / (2 sqrt(p q))    s opposite to corner i, p and q the others
//
// in    unit vectors
// out   squares of chords, cosines, degrees
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/triangle_mesh.h"

namespace rondel::meshing {

// Returns the square of the side opposite to each corner.
inline std::array<double, 3> squared_sides(const std::array<Point, 3>& corners) {
  std::array<double, 3> squares{};
  for (unsigned i = 0; i < 3; ++i) {
    const Point chord = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    squares[i] = dot(chord, chord);
  }
  return squares;
}

// Returns the cosine of the angle at each corner, which rounding may have moved beyond 1.
inline std::array<double, 3> cosines(const std::array<double, 3>& squares) {
  std::array<double, 3> found{};
  for (unsigned i = 0; i < 3; ++i) {
    const double p = squares[(i + 1) % 3];
    const double q = squares[(i + 2) % 3];
    found[i] = (p + q - squares[i]) / (2 * std::sqrt(p * q));
  }
  return found;
}

inline double degrees_of_cosine(double cosine) {
  const double at_most_one = std::clamp(cosine, -1.0, 1.0);
  const double sine = std::sqrt((1 - at_most_one) * (1 + at_most_one));
  return exact::argument(sine, at_most_one) * exact::degrees_per_radian;
}

// Returns the smallest angle of each triangle.
inline std::vector<double> smallest_angles_deg(const mesh::TriangleMesh& mesh) {
  std::vector<double> angles;
  angles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto of_triangle = cosines(squared_sides(
        {normalized(mesh.points[a]), normalized(mesh.points[b]), normalized(mesh.points[c])}));
    angles.push_back(degrees_of_cosine(*std::ranges::max_element(of_triangle)));
  }
  return angles;
}

}  // namespace rondel::meshing
