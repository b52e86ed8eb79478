// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/triangle_angles.h"
#include "rondel/triangle_mesh.h"
#include "system/arithmetic.h"

namespace rondel::mesh {

TriangleQuality triangle_quality(const TriangleMesh& mesh) {
  const system::ArithmeticScope arithmetic;
  double least = 4;
  double most = 0;
  double largest_cosine = -1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto squares = meshing::squared_sides(
        {normalized(mesh.points[a]), normalized(mesh.points[b]), normalized(mesh.points[c])});
    for (const double cosine : meshing::cosines(squares)) {
      largest_cosine = std::max(largest_cosine, cosine);
    }
    least = std::min(least, *std::ranges::min_element(squares));
    most = std::max(most, *std::ranges::max_element(squares));
  }
  if (mesh.triangles.empty()) return {};
  const auto angle_of = [](double square) {
    return 2 * exact::argument(std::sqrt(square), std::sqrt(std::max(4 - square, 0.0)));
  };
  return {meshing::degrees_of_cosine(largest_cosine), angle_of(least), angle_of(most)};
}

}  // namespace rondel::mesh
