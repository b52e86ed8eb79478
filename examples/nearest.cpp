// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Where is a point, and which sites are near it? A Locator answers, exactly, for one point or
// for many at once.

#include <cstdio>
#include <numbers>
#include <vector>

#include "rondel/rondel.h"

int main() {
  const std::vector<rondel::LonLat> positions = {
      {-0.46, 51.47},    // 0 London
      {2.55, 49.01},     // 1 Paris
      {8.57, 50.03},     // 2 Frankfurt
      {12.25, 41.80},    // 3 Rome
      {-3.57, 40.49},    // 4 Madrid
      {139.78, 35.55},   // 5 Tokyo
      {151.18, -33.95},  // 6 Sydney
      {-73.78, 40.64},   // 7 New York
      {28.25, -26.13},   // 8 Johannesburg
      {-46.47, -23.43},  // 9 Sao Paulo
  };
  const std::vector<rondel::Point> airports = rondel::unit_vectors(positions);
  const std::vector<rondel::Point> planes =
      rondel::unit_vectors(std::vector<rondel::LonLat>{{5.0, 47.0}, {-30.0, 50.0}, {100.0, -80.0}});
  const double degree = std::numbers::pi / 180;

  const rondel::Triangulation triangulation = rondel::delaunay(airports);
  const rondel::Locator locator(triangulation);

  const std::vector<rondel::Index> nearest = locator.nearest(planes);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    std::printf("plane %zu: airport %u, %.3f degrees away\n", i, nearest[i],
                locator.distance(planes[i], nearest[i]) / degree);
  }

  constexpr std::size_t k = 3;
  const std::vector<rondel::Index> rows = locator.k_nearest(planes, k);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    std::printf("plane %zu: then airports %u and %u\n", i, rows[k * i + 1], rows[k * i + 2]);
  }

  for (const rondel::Index airport : locator.within(planes[0], 10 * degree)) {
    std::printf("airport %u is within 10 degrees of plane 0\n", airport);
  }

  const rondel::Location place = locator.locate(planes[1]);
  if (place.where == rondel::Where::face) {
    std::printf("plane 1 is in face %u: airports %u, %u and %u\n", place.face, place.sites[0],
                place.sites[1], place.sites[2]);
  }

  std::printf("a new site at plane 0 would replace %zu faces\n",
              locator.conflict_region(planes[0]).size());
}
