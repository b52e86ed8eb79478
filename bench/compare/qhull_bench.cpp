// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// qhull_bench KIND N: measures the convex hull of the same sites by Qhull's reentrant library with
// the option "Qt" (triangulated output), from a copy of the coordinates in memory.

#include <libqhull_r/qhull_ra.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "inputs.h"
#include "measure.h"

namespace {

struct Free {
  void operator()(qhT* state) const {
    qh_freeqhull(state, qh_ALL);
    delete state;
  }
};
using Hull = std::unique_ptr<qhT, Free>;

Hull build(std::vector<coordT>& coordinates) {
  Hull hull(new qhT);
  qh_zero(hull.get(), stderr);
  char command[] = "qhull Qt";
  const int error = qh_new_qhull(hull.get(), 3, static_cast<int>(coordinates.size() / 3),
                                 coordinates.data(), False, command, nullptr, stderr);
  if (error != 0) std::exit(1);
  return hull;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: qhull_bench KIND N [--seed S]\n");
    return 2;
  }
  QHULL_LIB_CHECK
  rondel::bench::Source source(argv[1], argv[2], seed);
  const auto make = [&] {
    std::vector<coordT> coordinates;
    for (const auto& p : source.next()) {
      coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
    }
    return coordinates;
  };
  const auto count = [](const std::vector<coordT>& coordinates, const Hull& hull) {
    return rondel::bench::Counts{coordinates.size() / 3,
                                 static_cast<std::size_t>(hull->num_vertices),
                                 static_cast<std::size_t>(hull->num_facets)};
  };
  rondel::bench::print_build(rondel::bench::measure(make, build, count));
}
