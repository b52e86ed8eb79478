// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_bench KIND N [kernel|projection|insert]: CGAL's Delaunay triangulation on the sphere of
// the same sites, with the traits that take points as given or those that project them; `insert`:
// points as given, one by one in random order without hints.

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include "inputs.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Traits>
void measure(const std::vector<Kernel::Point_3>& points, bool one_by_one) {
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const auto start = std::chrono::steady_clock::now();
  const Traits traits(Kernel::Point_3(0, 0, 0), 1);
  CGAL::Delaunay_triangulation_on_sphere_2<Traits> triangulation(traits);
  if (one_by_one) {
    for (const auto& p : points) triangulation.insert(p);
  } else {
    triangulation.insert(points.begin(), points.end());
  }
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
    std::fprintf(stderr, "usage: cgal_bench KIND N [kernel|projection|insert]\n");
    return 2;
  }
  std::vector<Kernel::Point_3> points;
  for (const auto& p : rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10))) {
    points.emplace_back(p.x, p.y, p.z);
  }
  const char* mode = argc > 3 ? argv[3] : "kernel";
  const bool one_by_one = std::strcmp(mode, "insert") == 0;
  if (one_by_one) std::shuffle(points.begin(), points.end(), std::mt19937_64(1));
  if (std::strcmp(mode, "projection") == 0) {
    measure<CGAL::Projection_on_sphere_traits_3<Kernel>>(points, false);
  } else {
    measure<CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>>(points, one_by_one);
  }
}
