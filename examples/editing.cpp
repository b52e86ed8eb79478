// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Observatories come, move and go; the triangulation follows, and ids stay what they are.
#include <cstdio>
#include <vector>

#include "rondel/rondel.h"

namespace {

void print(const char* what, const rondel::DynamicTriangulation& network) {
  std::printf("%s: %zu sites, %zu vertices, %zu faces\n", what, network.num_sites(),
              network.num_vertices(), network.num_faces());
}

void print_neighbors(const rondel::DynamicTriangulation& network, rondel::Index id) {
  std::printf("neighbors of %u:", id);
  for (const rondel::Index neighbor : network.neighbors(id)) std::printf(" %u", neighbor);
  std::printf("\n");
}

}  // namespace

int main() {
  const std::vector<rondel::LonLat> places = {
      {-155.47, 19.82},  // 0 Mauna Kea
      {-70.40, -24.63},  // 1 Paranal
      {20.81, -32.38},   // 2 Sutherland
      {-17.88, 28.76},   // 3 La Palma
      {149.07, -31.27},  // 4 Siding Spring
      {78.96, 32.78},    // 5 Hanle
  };
  rondel::DynamicTriangulation network(rondel::unit_vectors(places));
  print("at first", network);

  const rondel::Index dome_c = network.insert(rondel::unit_vector({123.33, -75.10}));
  print("with Dome C", network);
  print_neighbors(network, dome_c);

  network.move(dome_c, rondel::unit_vector({-68.18, -67.57}));  // Rothera
  print_neighbors(network, dome_c);

  network.remove(rondel::Index{2});
  print("without Sutherland", network);

  // The plates drift: the site with the i-th id goes to the i-th point.
  std::vector<rondel::Point> drifted;
  for (const rondel::Index id : network.ids()) {
    const rondel::Point p = network.site(id);
    drifted.push_back({p.x - 0.01 * p.y, p.y + 0.01 * p.x, p.z});
  }
  network.move_all(drifted);
  print("after the drift", network);

  // An immutable copy for all that needs arrays. Site i of it is ids[i].
  const rondel::Snapshot now = network.snapshot();
  const rondel::Diagram cells = rondel::diagram(now.triangulation);
  for (std::size_t i = 0; i < now.ids.size(); ++i) {
    std::printf("site %u looks after %.3f steradians\n", now.ids[i], cells.areas[i]);
  }
}
