// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_delaunay3_bench KIND N: CGAL's Delaunay triangulation in space of the same sites and the
// center of the sphere, as in the paper: its convex hull is the triangulation on the sphere, and
// the center spares the predicates most sets of five cospherical points.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdio>
#include <iterator>
#include <memory>
#include <vector>

#include "compare/cgal_points.h"
#include "measure.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_delaunay3_bench KIND N\n");
    return 2;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel>;
  const auto points = rondel::bench::cgal_points<Kernel>(argv[1], argv[2]);
  const auto measured = rondel::bench::measure([&] {
    auto built = std::make_unique<Triangulation>();
    built->insert(Kernel::Point_3(0, 0, 0));
    built->insert(points.begin(), points.end());
    return built;
  });
  const Triangulation& triangulation = **measured.result;
  // The hull: what is beside the infinite vertex.
  std::vector<Triangulation::Vertex_handle> vertices;
  std::vector<Triangulation::Cell_handle> faces;
  triangulation.adjacent_vertices(triangulation.infinite_vertex(), std::back_inserter(vertices));
  triangulation.incident_cells(triangulation.infinite_vertex(), std::back_inserter(faces));
  rondel::bench::print_build(points.size(), vertices.size(), faces.size(), measured);
}
