// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Circles on the sphere as weighted sites: a circle of center direction q and angular radius r
// below 90 degrees is the point q / cos r. Its power cell is the part of the sphere where it
// is the nearest circle in the sense of Laguerre, and a circle may have no cell at all.

#include <cstdio>
#include <vector>

#include "rondel/rondel.h"

int main() {
  const std::vector<rondel::LonLat> centers = {
      {0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}, {10, 10},
  };
  const std::vector<double> radii_deg = {60, 20, 20, 20, 20, 20, 1};

  const std::vector<rondel::Point> sites = rondel::polar_points(centers, radii_deg);
  const rondel::Triangulation triangulation =
      rondel::delaunay(sites, {.model = rondel::Model::weighted});
  const rondel::Diagram diagram = rondel::diagram(triangulation);

  for (std::size_t i = 0; i < sites.size(); ++i) {
    std::printf("circle %zu: radius %.0f degrees, power cell %.6f steradians\n", i, radii_deg[i],
                diagram.areas[i]);
  }
  for (const auto& [site, face] : triangulation.hidden()) {
    const auto& [a, b, c] = triangulation.faces()[face];
    std::printf("circle %u is hidden below the face %u %u %u\n", site, a, b, c);
  }
  const auto& [rings, points] = diagram.cells;
  std::printf("the cell of circle 0 has the corners\n");
  for (const rondel::Index i : rings[0]) {
    const auto& [x, y, z] = points[i];
    std::printf("  %.6f %.6f %.6f\n", x, y, z);
  }
}
