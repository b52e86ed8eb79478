// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// The Voronoi cells of the sites in a file: which site serves the largest area of the Earth, and
// which the smallest?

#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>
#include <vector>

#include "rondel/io.h"
#include "rondel/rondel.h"

namespace {

constexpr double earth_radius_km = 6371.0088;  // mean radius, IUGG 1980

void print_site(const char* what, const rondel::SiteTable& table, std::size_t site, double area) {
  const rondel::LonLat& place = table.positions.at(site);
  std::printf("%s: site %zu at longitude %.5f, latitude %.5f, %.2f square km\n", what, site,
              place.lon_deg, place.lat_deg, area * earth_radius_km * earth_radius_km);
}

void print_areas(const char* path) {
  const rondel::SiteTable table = rondel::read_sites(path);
  const rondel::Triangulation triangulation = rondel::delaunay(table.sites);
  std::vector<double> areas = rondel::areas(triangulation);

  const double sum = std::reduce(areas.begin(), areas.end());
  const auto largest = std::max_element(areas.begin(), areas.end());
  print_site("largest", table, static_cast<std::size_t>(largest - areas.begin()), *largest);

  std::replace(areas.begin(), areas.end(), 0.0, sum);  // duplicates have no cell
  const auto smallest = std::min_element(areas.begin(), areas.end());
  print_site("smallest", table, static_cast<std::size_t>(smallest - areas.begin()), *smallest);
  std::printf("%zu cells, together %.10f steradians\n", triangulation.num_vertices(), sum);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: cell_areas FILE\n");
    return 2;
  }
  try {
    print_areas(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cell_areas: %s\n", error.what());
    return 1;
  }
}
