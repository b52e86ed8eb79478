// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// The Delaunay triangulation of a few cities.

#include <cstdio>
#include <vector>

#include "rondel/rondel.h"

int main() {
  const std::vector<rondel::LonLat> cities = {
      {2.35, 48.86},     // 0 Paris
      {-74.01, 40.71},   // 1 New York
      {139.69, 35.69},   // 2 Tokyo
      {151.21, -33.87},  // 3 Sydney
      {18.42, -33.92},   // 4 Cape Town
      {-43.17, -22.91},  // 5 Rio de Janeiro
      {2.35, 48.86},     // 6 Paris again
  };
  const rondel::Triangulation triangulation = rondel::delaunay(rondel::unit_vectors(cities));

  std::printf("%zu vertices, %zu faces\n", triangulation.num_vertices(), triangulation.num_faces());
  for (const auto& [a, b, c] : triangulation.faces()) {
    std::printf("face %u %u %u\n", a, b, c);
  }
  for (const auto& [site, representative] : triangulation.duplicates()) {
    std::printf("site %u is site %u\n", site, representative);
  }
}
