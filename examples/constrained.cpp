// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// A constrained Delaunay triangulation: a coast of three arcs among a few stations. Where two
// constraints cross, an error says which and where, or the crossing becomes a site. Values at the
// stations are interpolated on either side of the coast.

#include "rondel/constrained.h"

#include <array>
#include <cstdio>
#include <vector>

#include "rondel/constrained_interpolate.h"
#include "rondel/delaunay.h"

int main() {
  const std::vector<rondel::Point> sites =
      rondel::unit_vectors(std::vector<rondel::LonLat>{{0, 50},
                                                       {4, 52},
                                                       {9, 54},
                                                       {20, 54},  // the coast
                                                       {5, 60},
                                                       {8, 53},
                                                       {10, 55},
                                                       {12, 48},
                                                       {25, 62}});
  std::vector<std::array<rondel::Index, 2>> coast = {{0, 1}, {1, 2}, {2, 3}};
  const auto result = rondel::constrained_delaunay(sites, coast);
  std::printf("%zu faces, %zu of them ghosts\n", result.triangulation.num_faces(),
              result.triangulation.num_ghost_faces());
  for (std::size_t i = 0; i < result.edges.size(); ++i) {
    const auto [a, b] = result.edges[i];
    std::printf("edge %u-%u comes from constraint %u\n", a, b, result.sources[i][0]);
  }

  const std::vector<double> warmth = {15, 15, 15, 15, 9, 21, 10, 24, 8};  // cold at sea
  const std::vector<rondel::Point> places =
      rondel::unit_vectors(std::vector<rondel::LonLat>{{8, 53.4}, {10, 53.9}, {10, 54.2}});
  const rondel::ConstrainedInterpolator interpolator(result);
  for (const double value : interpolator.values(warmth, places))
    std::printf("%.1f degrees\n", value);

  coast.push_back({4, 7});  // a border
  try {
    static_cast<void>(rondel::constrained_delaunay(sites, coast));
  } catch (const rondel::CrossingConstraints& error) {
    const auto [first, second] = error.constraints();
    std::printf("constraints %u and %u cross at %.2f E, %.2f N\n", first, second,
                error.place().lon_deg, error.place().lat_deg);
  }
  const auto split =
      rondel::constrained_delaunay(sites, coast, {.crossings = rondel::ConstraintCrossings::split});
  std::printf("%zu sites and %zu constrained edges after the split\n",
              split.triangulation.num_sites(), split.edges.size());
}
