// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// mesh_bench BISECTIONS FILE [THREADS]: measures the mesh of an icosahedron with 10 * 4^BISECTIONS
// + 2 cells, its quality, and writing and reading its MPAS file, in seconds; prints one JSON
// object.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/mesh.h"
#include "rondel/mesh_formats.h"
#include "rondel/mesh_quality.h"

namespace {

using rondel::Point;
using rondel::bench::seconds_of;

Point at_one(const Point& p) {
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

std::vector<Point> icosahedral_sites(int bisections, const rondel::Execution& execution) {
  const double golden = std::numbers::phi;
  std::vector<Point> sites;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-golden, golden}) {
      sites.push_back(at_one({0, s, t}));
      sites.push_back(at_one({s, t, 0}));
      sites.push_back(at_one({t, 0, s}));
    }
  }
  for (; bisections > 0; --bisections) {
    for (const auto& [a, b] : rondel::edges(rondel::delaunay(sites, {}, execution))) {
      const Point& p = sites[a];
      const Point& q = sites[b];
      sites.push_back(at_one({p.x + q.x, p.y + q.y, p.z + q.z}));
    }
  }
  return sites;
}

void run(int bisections, const char* file, unsigned threads) {
  const rondel::Execution execution{.threads = threads};
  const std::vector<Point> sites = icosahedral_sites(bisections, execution);
  rondel::Triangulation triangulation;
  rondel::mesh::VoronoiMesh arrays;
  rondel::mesh::VoronoiMesh again;
  const double of_delaunay =
      seconds_of([&] { triangulation = rondel::delaunay(sites, {}, execution); });
  const double of_arrays = seconds_of([&] {
    arrays = rondel::mesh::make_mesh(triangulation, {.allow_zero_edges = true}, execution);
  });
  triangulation = {};
  double ratio = 0;
  const double of_quality =
      seconds_of([&] { ratio = rondel::mesh::quality(arrays, execution).min_edge_ratio.value; });
  const double of_write = seconds_of([&] { rondel::mesh::write(file, arrays, {}, execution); });
  const auto bytes = std::filesystem::file_size(file);
  const std::size_t edges = arrays.num_edges();
  arrays = {};
  const double of_read = seconds_of([&] { again = rondel::mesh::read_mpas(file, execution); });
  if (again.num_edges() != edges) std::abort();
  std::printf(R"({"cells": %zu, "threads": %u, "bytes": %llu, "min_edge_ratio": %.4f, "seconds": )"
              R"({"delaunay": %.2f, "arrays": %.2f, "quality": %.2f, "write": %.2f, "read": %.2f}})"
              "\n",
              again.num_cells(), threads, static_cast<unsigned long long>(bytes), ratio,
              of_delaunay, of_arrays, of_quality, of_write, of_read);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: mesh_bench BISECTIONS FILE [THREADS]\n");
    return 2;
  }
  run(std::atoi(argv[1]), argv[2], argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1);
}
