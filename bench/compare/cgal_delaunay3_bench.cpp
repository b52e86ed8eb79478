// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_delaunay3_bench KIND N: measures CGAL's Delaunay triangulation in space of the same sites
// and the center of the sphere, as in the paper: its convex hull is the triangulation on the
// sphere, and with the center the predicates meet fewer sets of five cospherical points.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdio>
#include <iterator>
#include <memory>
#include <vector>

#include "compare/cgal_points.h"
#include "measure.h"

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_delaunay3_bench KIND N [--seed S]\n");
    return 2;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel>;
  using Points = std::vector<Kernel::Point_3>;
  rondel::bench::Source source(argv[1], argv[2], seed);
  const auto make = [&] { return rondel::bench::cgal_points<Kernel>(source.next()); };
  const auto build = [](const Points& points) {
    auto built = std::make_unique<Triangulation>();
    built->insert(Kernel::Point_3(0, 0, 0));
    built->insert(points.begin(), points.end());
    return built;
  };
  // The hull consists of the neighbors of the infinite vertex.
  const auto count = [](const Points& points, const auto& built) {
    std::vector<Triangulation::Vertex_handle> vertices;
    std::vector<Triangulation::Cell_handle> faces;
    built->adjacent_vertices(built->infinite_vertex(), std::back_inserter(vertices));
    built->incident_cells(built->infinite_vertex(), std::back_inserter(faces));
    return rondel::bench::Counts{points.size(), vertices.size(), faces.size()};
  };
  rondel::bench::print_build(rondel::bench::measure(make, build, count));
}
