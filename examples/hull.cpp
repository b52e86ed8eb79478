// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// The convex hull of points in space. A facet of this one has five points: its four
// corners are vertices, the one in its middle is not. A flat set has a polygon for a hull.

#include <cstdio>
#include <vector>

#include "rondel/rondel.h"

int main() {
  const std::vector<rondel::Point> points = {
      {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0},  // the base of a pyramid
      {2, 2, 0},                                   // in its middle
      {2, 2, 3},                                   // the apex
      {2, 2, 1},                                   // inside
      {4, 4, 0},                                   // a corner again
  };
  const rondel::Triangulation hull = rondel::convex_hull(points);
  const rondel::HullSize size = rondel::size_of_hull(hull);

  std::printf("%zu vertices, %zu faces, volume %g, area %.6f\n", hull.num_vertices(),
              hull.num_faces(), size.volume, size.area);
  for (const auto& [a, b, c] : hull.faces()) std::printf("face %u %u %u\n", a, b, c);
  for (const auto& [site, face] : hull.hidden()) {
    const auto& [a, b, c] = hull.faces()[face];
    std::printf("point %u is no vertex; it is below face %u %u %u\n", site, a, b, c);
  }
  for (const auto& [site, representative] : hull.duplicates()) {
    std::printf("point %u is point %u\n", site, representative);
  }

  const rondel::Triangulation base =
      rondel::convex_hull(std::vector(points.begin(), points.begin() + 5));
  std::printf("the base is flat (dimension %d); its corners are", base.dimension());
  for (const rondel::Index corner : base.ring()) std::printf(" %u", corner);
  std::printf("\n");
}
