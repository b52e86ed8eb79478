// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// refine_bench SITES VERTICES [ANGLE] [--seed S]: measures the refinement of the triangulation of
// uniform sites to about so many vertices of equal spacing, on one thread. Each edge of a tenth of
// the faces is a constraint. Prints medians of five runs, with an input each, as one JSON object.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_refine.h"

namespace {

using rondel::Index;
using rondel::bench::median;
using rondel::bench::seconds_of;

constexpr int repetitions = 5;

rondel::ConstrainedTriangulation make_triangulation(std::size_t n, std::uint64_t seed) {
  const auto sites = rondel::bench::make_input("uniform", n, seed);
  const rondel::Triangulation plain = delaunay(sites);
  std::vector<std::array<Index, 2>> constraints;
  for (std::size_t f = 0; f < plain.num_faces(); f += 10) {
    const auto& [a, b, c] = plain.faces()[f];
    constraints.insert(constraints.end(), {{a, b}, {b, c}, {c, a}});
  }
  return constrained_delaunay(sites, constraints);
}

void run(std::size_t n, std::size_t wanted, double angle, std::uint64_t seed) {
  std::vector<double> seconds;
  std::vector<double> micros;
  std::size_t vertices = 0;
  for (int i = 0; i < repetitions; ++i) {
    const auto given = make_triangulation(n, seed + static_cast<unsigned>(i));
    const std::vector<Index> regions(given.triangulation.num_faces(), 0);
    rondel::mesh::RefineOptions options;
    options.smallest_angle_deg = angle;
    if (wanted > 0) options.spacing = rondel::mesh::SizeFunction::of_count(wanted);
    rondel::mesh::RefinedMesh mesh;
    seconds.push_back(seconds_of([&] { mesh = refine(given, regions, options, {.threads = 1}); }));
    vertices = mesh.nodes.size();
    micros.push_back(seconds.back() / static_cast<double>(vertices) * 1e6);
  }
  std::printf(R"({"sites": %zu, "angle_deg": %.1f, "vertices": %zu, )", n, angle, vertices);
  std::printf(R"("seconds": %.4f, "us_per_vertex": %.3f})"
              "\n",
              median(seconds), median(micros));
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: refine_bench SITES VERTICES [ANGLE] [--seed S]\n");
    return 2;
  }
  rondel::bench::keep_freed_memory();
  run(static_cast<std::size_t>(std::atoll(argv[1])), static_cast<std::size_t>(std::atoll(argv[2])),
      argc > 3 ? std::atof(argv[3]) : 26.5, seed);
  return 0;
}
