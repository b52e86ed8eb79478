// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// qhull_bench KIND N: the convex hull of the same sites by Qhull's reentrant library, option "Qt"
// (triangulated output), from a copy of the coordinates in memory.

#include <libqhull_r/qhull_ra.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "inputs.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: qhull_bench KIND N\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  std::vector<coordT> coordinates;
  coordinates.reserve(3 * sites.size());
  for (const auto& p : sites) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});

  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const auto start = std::chrono::steady_clock::now();
  qhT state;
  QHULL_LIB_CHECK
  qh_zero(&state, stderr);
  char command[] = "qhull Qt";
  const int error = qh_new_qhull(&state, 3, static_cast<int>(sites.size()), coordinates.data(),
                                 False, command, nullptr, stderr);
  if (error != 0) return 1;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  std::printf(
      "{\"sites\": %zu, \"vertices\": %d, \"faces\": %d, \"seconds\": %.6f, "
      "\"bytes_per_site\": %.1f}\n",
      sites.size(), state.num_vertices, state.num_facets, seconds,
      static_cast<double>(after.ru_maxrss - before.ru_maxrss) * 1024 /
          static_cast<double>(sites.size()));
  qh_freeqhull(&state, qh_ALL);
}
