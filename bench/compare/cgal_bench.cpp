// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_bench KIND N [kernel|projection]: CGAL's Delaunay triangulation on the sphere of
// the same sites, with the traits that take points as given or those that project them.

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "inputs.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Traits>
void measure(const std::vector<Kernel::Point_3>& points) {
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const auto start = std::chrono::steady_clock::now();
  const Traits traits(Kernel::Point_3(0, 0, 0), 1);
  const CGAL::Delaunay_triangulation_on_sphere_2<Traits> triangulation(points.begin(), points.end(),
                                                                       traits);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  std::printf(
      "{\"sites\": %zu, \"vertices\": %zu, \"faces\": %zu, \"seconds\": %.6f, "
      "\"bytes_per_site\": %.1f}\n",
      points.size(), static_cast<std::size_t>(triangulation.number_of_vertices()),
      static_cast<std::size_t>(triangulation.number_of_faces()), seconds,
      static_cast<double>(after.ru_maxrss - before.ru_maxrss) * 1024 /
          static_cast<double>(points.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_bench KIND N [kernel|projection]\n");
    return 2;
  }
  std::vector<Kernel::Point_3> points;
  for (const auto& p : rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10))) {
    points.emplace_back(p.x, p.y, p.z);
  }
  if (argc > 3 && std::strcmp(argv[3], "projection") == 0) {
    measure<CGAL::Projection_on_sphere_traits_3<Kernel>>(points);
  } else {
    measure<CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>>(points);
  }
}
