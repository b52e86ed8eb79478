// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "exact/angles.h"
#include "exact/vector.h"
#include "rondel/triangle_mesh.h"
#include "system/arithmetic.h"

namespace rondel::mesh {

TriangleQuality triangle_quality(const TriangleMesh& mesh) {
  const system::ArithmeticScope arithmetic;
  const auto square_of_chord = [&](Index a, Index b) {
    const Point chord = normalized(mesh.points[b]) - normalized(mesh.points[a]);
    return dot(chord, chord);
  };
  double least = 4;
  double most = 0;
  double largest_cosine = -1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<double, 3> squares = {square_of_chord(b, c), square_of_chord(c, a),
                                           square_of_chord(a, b)};
    for (unsigned i = 0; i < 3; ++i) {
      const double p = squares[(i + 1) % 3];
      const double q = squares[(i + 2) % 3];
      largest_cosine = std::max(largest_cosine, (p + q - squares[i]) / (2 * std::sqrt(p * q)));
      least = std::min(least, squares[i]);
      most = std::max(most, squares[i]);
    }
  }
  if (mesh.triangles.empty()) return {};
  const auto angle_of = [](double square) {
    return 2 * exact::argument(std::sqrt(square), std::sqrt(std::max(4 - square, 0.0)));
  };
  const double cosine = std::min(largest_cosine, 1.0);
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return {exact::argument(sine, cosine) * exact::degrees_per_radian, angle_of(least),
          angle_of(most)};
}

}  // namespace rondel::mesh
