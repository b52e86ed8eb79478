// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loudspeakers around a listener, and regions of a planet: what a renderer of sound and a game ask. The
// program compiles with the two files of scripts/amalgamate, or against the installed package.
#include <cstdio>
#include <vector>

#if __has_include("rondel_all.h")
#include "rondel_all.h"
#else
#include "rondel/rondel.h"
#endif

namespace {

double det(const rondel::Point& a, const rondel::Point& b, const rondel::Point& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}

// The gains of three loudspeakers for a source in this direction (vector base amplitude panning):
// how much of each adds up to it.
void print_gains(const rondel::Triangulation& layout, const rondel::Locator& locator,
                 const rondel::Point& source) {
  const rondel::Location at = locator.locate(source);
  if (at.where == rondel::Where::outside) return;
  const auto sites = layout.sites().points();
  const auto& [i, j, k] = layout.faces()[at.face];
  const double all = det(sites[i], sites[j], sites[k]);
  std::printf("speakers %u %u %u: %.3f %.3f %.3f\n", i, j, k, det(source, sites[j], sites[k]) / all,
              det(sites[i], source, sites[k]) / all, det(sites[i], sites[j], source) / all);
}

}  // namespace

int main() {
  // Loudspeakers by azimuth and elevation: a ring, four above it, one below.
  const std::vector<rondel::LonLat> speakers = {
      {30, 0}, {-30, 0}, {110, 0}, {-110, 0}, {45, 45}, {-45, 45}, {135, 45}, {-135, 45}, {0, -90}};
  const rondel::Triangulation layout = rondel::delaunay(rondel::unit_vectors(speakers));
  const rondel::CompressedRows<rondel::Index> facets = rondel::merge_cocircular(layout);
  std::printf("%zu facets, the largest of", facets.size());
  std::size_t largest = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].size() > facets[largest].size()) largest = f;
  }
  for (const rondel::Index speaker : facets[largest]) std::printf(" %u", speaker);
  std::printf("\n");
  print_gains(layout, rondel::Locator(layout), rondel::unit_vector({10, 20}));

  // A rock, for collisions: the hull of its points.
  const std::vector<rondel::Point> rock = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0},
                                           {2, 2, 3}, {2, 2, 1}, {1, 2, 0}};
  const rondel::Triangulation hull = rondel::convex_hull(rock);
  std::printf("the rock: %zu of %zu points, volume %g\n", hull.num_vertices(), rock.size(),
              rondel::size_of_hull(hull).volume);

  // Towns of a planet: the region of each is its Voronoi cell.
  const std::vector<rondel::LonLat> towns = {{0, 10},   {80, -20}, {170, 40},
                                             {-100, 0}, {30, -70}, {-40, 75}};
  const rondel::Triangulation planet = rondel::delaunay(rondel::unit_vectors(towns));
  const rondel::Diagram regions = rondel::diagram(planet);
  for (std::size_t town = 0; town < towns.size(); ++town) {
    std::printf("town %zu: %zu corners, %.3f steradians\n", town, regions.cells.rings[town].size(),
                regions.areas[town]);
  }
  const rondel::Locator map(planet);
  const rondel::Index home = map.nearest(rondel::unit_vector({60, 5}));
  std::printf("the ship is at town %u, next to", home);
  for (const rondel::Index town : map.neighbors(home)) std::printf(" %u", town);
  std::printf("\n");
}
