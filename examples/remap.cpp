// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Rain over the Voronoi cells of one set of sites, carried to those of another, and onto a grid.

#include "rondel/remap.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <vector>

#include "rondel/rondel.h"

namespace {

std::vector<rondel::Point> spiral(int count) {
  std::vector<rondel::Point> sites;
  constexpr double golden_deg = 137.50776405003785;
  for (int i = 0; i < count; ++i) {
    sites.push_back(rondel::unit_vector({i * golden_deg, 90 - 180 * (i + 0.5) / count}));
  }
  return sites;
}

double integral(const std::vector<double>& means, const std::vector<double>& areas) {
  double sum = 0;
  for (std::size_t i = 0; i < means.size(); ++i) sum += means[i] * areas[i];
  return sum;
}

void carry_rain() {
  const auto coarse = rondel::CellSet::voronoi(rondel::delaunay(spiral(500)));
  const auto fine = rondel::CellSet::voronoi(rondel::delaunay(spiral(2000)));
  std::vector<double> rain;
  for (const rondel::Point& p : spiral(500)) rain.push_back(1 + p.x * p.y + p.z);
  for (const unsigned order : {1U, 2U}) {
    const rondel::Remap remap = rondel::remap(coarse, fine, {.order = order});
    std::vector<double> carried(fine.num_cells());
    rondel::apply(remap.weights, rain, carried);
    std::printf("order %u: %d pieces, %d weights, integral %.12f, before %.12f\n", order,
                static_cast<int>(remap.areas.size()), static_cast<int>(remap.weights.values.size()),
                integral(carried, remap.target_areas), integral(rain, remap.source_areas));
  }
}

// Onto a grid of 30 degrees, whose cells are between meridians and parallels.
void carry_to_grid() {
  const auto cells = rondel::CellSet::voronoi(rondel::delaunay(spiral(500)));
  const auto grid = rondel::CellSet::lonlat_grid(rondel::GlobalGrid{12, 6});
  const rondel::Remap remap = rondel::remap(cells, grid);
  double least = 1;
  for (const double fraction : remap.target_fractions) least = std::min(least, fraction);
  std::printf("grid: %d pieces, every cell covered to %.12f\n",
              static_cast<int>(remap.areas.size()), least);
}

}  // namespace

int main() {
  try {
    carry_rain();
    carry_to_grid();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "remap: %s\n", error.what());
    return 1;
  }
}
