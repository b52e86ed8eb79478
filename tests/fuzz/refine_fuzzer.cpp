// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/mesh_refine.h: what it promises of any sites, constraints, regions and settings.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/constrained.h"
#include "rondel/mesh_refine.h"
#include "support/refine_laws.h"

namespace rondel::fuzz {
namespace {

using Edge = std::array<Index, 2>;

// Removes constraints until none is refused, and returns the triangulation of the rest.
ConstrainedTriangulation without_bad(const std::vector<Point>& sites,
                                     std::vector<Edge>& constraints) {
  while (true) {
    try {
      return constrained_delaunay(sites, constraints);
    } catch (const InvalidInput& error) {
      require(error.index() < constraints.size(), "a constraint is named");
      constraints.erase(constraints.begin() + static_cast<std::ptrdiff_t>(error.index()));
    }
  }
}

mesh::RefineOptions next_options(ByteSource& source) {
  mesh::RefineOptions options;
  options.smallest_angle_deg = static_cast<double>(source.below(34));
  options.most_vertices = 2000;
  if (source.below(4) == 0) {
    const double spacing = 0.02 * static_cast<double>(1 + source.byte());
    options.spacing = mesh::SizeFunction::constant(std::min(spacing, 3.0), 16);
    if (source.below(2) == 0) {
      options.spacing =
          options.spacing->refined(std::vector<Point>{{1, 0, 0}}, spacing / 8, 0.3).limited(0.3);
    }
  }
  return options;
}

void test_laws(const std::vector<Point>& sites, std::vector<Edge> constraints,
               const mesh::RefineOptions& options, Index left_out) {
  const ConstrainedTriangulation given = without_bad(sites, constraints);
  const auto regions = test::regions_by_sign(given.triangulation, &Point::z, left_out);
  try {
    const mesh::RefinedMesh mesh = refine(given, regions, options);
    const std::string flaw = test::RefineLaws(given, regions, options, mesh).flaw();
    require(flaw.empty(), flaw);
    std::ranges::reverse(constraints);
    for (Edge& edge : constraints) std::swap(edge[0], edge[1]);
    const ConstrainedTriangulation reversed = constrained_delaunay(sites, constraints);
    const mesh::RefinedMesh again = refine(reversed, regions, options, {.threads = 2});
    require(test::points_of(again) == test::points_of(mesh),
            "the order of constraints changes nothing");
  } catch (const InvalidInput&) {  // too many vertices
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const fuzz::Scales scales = fuzz::next_scales(source);
  const mesh::RefineOptions options = fuzz::next_options(source);
  const std::size_t left_out = source.below(5);
  std::vector<std::array<Index, 2>> constraints(source.below(16));
  for (auto& [a, b] : constraints) {
    a = source.byte() % 12;
    b = source.byte() % 12;
  }
  const std::vector<Point> sites = fuzz::all_sites(source, 12, scales, {Model::projected, {}});
  fuzz::test_laws(sites, constraints, options, static_cast<Index>(left_out));
  return 0;
}
