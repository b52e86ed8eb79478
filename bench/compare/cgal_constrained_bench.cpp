// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_constrained_bench N CONSTRAINTS [--seed S]: measures CGAL's constrained Delaunay
// triangulation of the plane for the longitudes and latitudes of the input of constrained_bench,
// with exact predicates and in bulk. What CGAL computes is less: nothing is joined across the
// antimeridian or around the poles, and constraints across the antimeridian are left out.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "constraints.h"
#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>;
using rondel::Index;
using rondel::bench::median;
using rondel::bench::seconds_of;

void run(std::size_t n, std::size_t wanted, std::uint64_t seed) {
  constexpr int repetitions = 5;
  std::vector<double> plain;
  std::vector<double> constrained;
  std::size_t num_vertices = 0;
  for (int i = 0; i < repetitions; ++i) {
    const auto sites = rondel::bench::make_input("uniform", n, seed + static_cast<unsigned>(i));
    std::vector<Kernel::Point_2> points;
    for (const rondel::LonLat& place : rondel::lonlats(sites)) {
      points.emplace_back(place.lon_deg, place.lat_deg);
    }
    std::vector<std::pair<std::size_t, std::size_t>> constraints;
    for (const auto& [a, b] : rondel::bench::random_constraints(sites, wanted)) {
      if (std::abs(points[a].x() - points[b].x()) < 180) constraints.emplace_back(a, b);
    }
    plain.push_back(seconds_of([&] {
      Triangulation made;
      made.insert(points.begin(), points.end());
      num_vertices = made.number_of_vertices();
    }));
    constrained.push_back(seconds_of([&] {
      Triangulation made;
      made.insert_constraints(points.begin(), points.end(), constraints.begin(), constraints.end());
      num_vertices = made.number_of_vertices();
    }));
  }
  std::printf(R"({"sites": %zu, "vertices": %zu, "delaunay_seconds": %.4f, )", n, num_vertices,
              median(plain));
  std::printf("\"constrained_seconds\": %.4f}\n", median(constrained));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_constrained_bench N CONSTRAINTS [--seed S]\n");
    return 2;
  }
  rondel::bench::keep_freed_memory();
  run(static_cast<std::size_t>(std::atoll(argv[1])), static_cast<std::size_t>(std::atoll(argv[2])),
      seed);
  return 0;
}
