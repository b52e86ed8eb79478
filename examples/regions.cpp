// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// The Voronoi cells of stations on an island with a lake, and what belongs to each of two offices.

#include "rondel/regions.h"

#include <cstdio>
#include <exception>
#include <numeric>
#include <vector>

#include "rondel/rondel.h"

namespace {

// A polygon around (lon, lat), counterclockwise for a positive size in degrees, clockwise for a negative one.
void add_ring(rondel::CellRings& cells, double lon, double lat, double size) {
  for (const rondel::LonLat& corner :
       {rondel::LonLat{lon - size, lat - 8}, rondel::LonLat{lon + size, lat - 8},
        rondel::LonLat{lon + size, lat + 8}, rondel::LonLat{lon - size, lat + 8}}) {
    cells.corners.push_back(static_cast<rondel::Index>(cells.points.size()));
    cells.points.push_back(rondel::unit_vector(corner));
  }
  cells.rings.push_back(cells.corners.size());
}

std::vector<rondel::Point> spiral(int count) {
  std::vector<rondel::Point> sites;
  sites.reserve(static_cast<std::size_t>(count));
  constexpr double golden_deg = 137.50776405003785;
  for (int i = 0; i < count; ++i) {
    sites.push_back(rondel::unit_vector({i * golden_deg, 90 - 180 * (i + 0.5) / count}));
  }
  return sites;
}

void divide_island() {
  rondel::CellRings island;
  add_ring(island, 180, 0, 30);  // across the date line
  add_ring(island, 170, 0, -5);  // its lake
  island.cells.push_back(2);

  const auto stations = spiral(500);
  const auto cells = rondel::CellSet::voronoi(rondel::delaunay(stations));
  const rondel::CellRings clipped = rondel::clip(cells, rondel::CellSet::polygons(island));
  std::vector<rondel::Index> offices;
  offices.reserve(stations.size());
  for (const rondel::Point& p : stations) offices.push_back(p.z < 0 ? 0 : 1);
  const rondel::CellRings joined = rondel::dissolve(clipped, offices, 2);

  const auto total = [](const std::vector<double>& areas) {
    return std::accumulate(areas.begin(), areas.end(), 0.0);
  };
  constexpr double squared_radius = 6371.0 * 6371.0;
  int num_cells = 0;
  for (const double area : rondel::areas(clipped)) num_cells += area > 0 ? 1 : 0;
  std::printf("%d cells, %.3f km^2, the island has %.3f\n", num_cells,
              squared_radius * total(rondel::areas(clipped)),
              squared_radius * total(rondel::areas(island)));
  for (std::size_t i = 0; i < 2; ++i) {
    std::printf("office %d: %.0f km^2, %d rings\n", static_cast<int>(i),
                squared_radius * rondel::areas(joined)[i],
                static_cast<int>(joined.cells[i + 1] - joined.cells[i]));
  }
}

}  // namespace

int main() {
  try {
    divide_island();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "regions: %s\n", error.what());
    return 1;
  }
}
