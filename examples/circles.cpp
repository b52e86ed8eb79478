// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Circles on the sphere as weighted sites: a circle of center direction q and angular radius r
// below 90 degrees is the point q / cos r. Its power cell is the part of the sphere where it
// is the nearest circle in the sense of Laguerre, and a circle may have no cell at all.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "rondel/rondel.h"

namespace {

struct Circle {
  rondel::LonLat center;
  double radius_deg;
};

rondel::Point pole_of(const Circle& circle) {
  const rondel::Point q = rondel::unit_vector(circle.center);
  const double scale = 1 / std::cos(circle.radius_deg * std::numbers::pi / 180);
  return {q.x * scale, q.y * scale, q.z * scale};
}

}  // namespace

int main() {
  const std::vector<Circle> circles = {
      {{0, 0}, 60},  {{90, 0}, 20},  {{180, 0}, 20}, {{-90, 0}, 20},
      {{0, 90}, 20}, {{0, -90}, 20}, {{10, 10}, 1},  // the last lies deep in the first
  };
  std::vector<rondel::Point> sites;
  sites.reserve(circles.size());
  for (const Circle& circle : circles) {
    sites.push_back(pole_of(circle));
  }
  const rondel::Triangulation triangulation =
      rondel::delaunay(sites, {.model = rondel::Model::weighted});
  const rondel::Cells cells = rondel::cells(triangulation, sites);
  const std::vector<double> areas = rondel::areas(triangulation, sites, cells);

  for (std::size_t i = 0; i < circles.size(); ++i) {
    std::printf("circle %zu: radius %.0f degrees, power cell %.6f steradians\n", i,
                circles[i].radius_deg, areas[i]);
  }
  for (const rondel::Hidden& hidden : triangulation.hidden()) {
    std::printf("circle %u is hidden\n", hidden.site);
  }
}
