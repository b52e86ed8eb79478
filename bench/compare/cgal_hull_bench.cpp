// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_hull_bench KIND N: measures the convex hull of the same sites by CGAL's convex_hull_3 with
// exact predicates, as a Surface_mesh.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cstdio>

#include "compare/cgal_points.h"
#include "measure.h"

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_hull_bench KIND N [--seed S]\n");
    return 2;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Points = std::vector<Kernel::Point_3>;
  rondel::bench::Source source(argv[1], argv[2], seed);
  const auto make = [&] { return rondel::bench::cgal_points<Kernel>(source.next()); };
  const auto build = [](const Points& points) {
    Mesh hull;
    CGAL::convex_hull_3(points.begin(), points.end(), hull);
    return hull;
  };
  const auto count = [](const Points& points, const Mesh& hull) {
    return rondel::bench::Counts{points.size(), hull.number_of_vertices(), hull.number_of_faces()};
  };
  rondel::bench::print_build(rondel::bench::measure(make, build, count));
}
