// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_hull_bench KIND N: the convex hull of the same sites by CGAL's convex_hull_3 with exact
// predicates, as a Surface_mesh.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "inputs.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_hull_bench KIND N\n");
    return 2;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  for (const auto& p : rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10))) {
    points.emplace_back(p.x, p.y, p.z);
  }
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const auto start = std::chrono::steady_clock::now();
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  std::printf(
      "{\"sites\": %zu, \"vertices\": %zu, \"faces\": %zu, \"seconds\": %.6f, "
      "\"bytes_per_site\": %.1f}\n",
      points.size(), static_cast<std::size_t>(hull.number_of_vertices()),
      static_cast<std::size_t>(hull.number_of_faces()), seconds,
      static_cast<double>(after.ru_maxrss - before.ru_maxrss) * 1024 /
          static_cast<double>(points.size()));
}
