// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A client of rondel::mesh: the mesh of an icosahedron, and an exception that crosses the library's border.

#include <rondel/delaunay.h>
#include <rondel/error.h>
#include <rondel/mesh.h>

#include <cstdio>
#include <span>
#include <vector>

int main() {
  std::vector<rondel::Point> sites;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.618, 1.618}) {
      sites.push_back({0, s, t});
      sites.push_back({s, t, 0});
      sites.push_back({t, 0, s});
    }
  }
  const rondel::mesh::MeshArrays mesh = rondel::mesh::arrays(rondel::delaunay(sites));
  bool has_thrown = false;
  try {
    rondel::mesh::arrays(
        rondel::delaunay(rondel::Sites(std::span<const rondel::Point>(sites).first(3))));
  } catch (const rondel::InvalidInput&) {
    has_thrown = true;
  }
  std::printf("%zu cells, %s\n", mesh.num_cells(), has_thrown ? "an error" : "no error");
}
