// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_bench KIND N [kernel|projection|insert]: measures CGAL's Delaunay triangulation on the
// sphere for the same sites, with the traits that take points as given (kernel) or project them
// (projection); `insert` takes points as given, one by one in random order without hints.

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "compare/cgal_points.h"
#include "measure.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using Points = std::vector<Kernel::Point_3>;

template <class Traits>
void run(rondel::bench::Source source, bool one_by_one) {
  using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<Traits>;
  const auto make = [&] {
    auto points = rondel::bench::cgal_points<Kernel>(source.next());
    if (one_by_one) std::shuffle(points.begin(), points.end(), std::mt19937_64(1));
    return points;
  };
  const auto build = [&](const Points& points) {
    auto built = std::make_unique<Triangulation>(Traits(Kernel::Point_3(0, 0, 0), 1));
    if (one_by_one) {
      for (const auto& p : points) built->insert(p);
    } else {
      built->insert(points.begin(), points.end());
    }
    return built;
  };
  rondel::bench::print_build(
      rondel::bench::measure(make, build, [](const Points& points, const auto& built) {
        return rondel::bench::Counts{points.size(), built->number_of_vertices(),
                                     built->number_of_faces()};
      }));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_bench KIND N [kernel|projection|insert] [--seed S]\n");
    return 2;
  }
  const rondel::bench::Source source(argv[1], argv[2], seed);
  const std::string mode = argc > 3 ? argv[3] : "kernel";
  if (mode == "projection") {
    run<CGAL::Projection_on_sphere_traits_3<Kernel>>(source, false);
  } else {
    run<CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>>(source, mode == "insert");
  }
}
