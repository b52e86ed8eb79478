// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel_bench KIND N [projected|weighted|hull] [dual] [THREADS]: one build in this process, and
// one JSON object on standard output. Scripts repeat it in turns with the peers.

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "inputs.h"
#include "rondel/rondel.h"

namespace {

long peak_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: rondel_bench KIND N [projected|weighted|hull] [dual] [THREADS]\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  rondel::Options options;
  options.threads = argc > 5 ? static_cast<unsigned>(std::atoi(argv[5])) : 1;
  const char* const what = argc > 3 ? argv[3] : "projected";
  if (std::strcmp(what, "weighted") == 0) options.model = rondel::Model::weighted;

  const long before = peak_kib();
  const double start = now();
  const auto triangulation = std::strcmp(what, "hull") == 0
                                 ? rondel::convex_hull(sites, {.threads = options.threads})
                                 : rondel::delaunay(sites, options);
  const double triangulated = now();
  const long after = peak_kib();
  double dual = 0;
  double total_area = 0;
  if (argc > 4) {
    const auto diagram = rondel::diagram(triangulation, sites);
    dual = now() - triangulated;
    total_area = std::accumulate(diagram.areas.begin(), diagram.areas.end(), 0.0);
  }
  const auto n = static_cast<double>(sites.size());
  const auto& report = triangulation.report();
  std::printf(
      "{\"sites\": %zu, \"vertices\": %zu, \"faces\": %zu, \"seconds\": %.6f, \"order\": %.6f, "
      "\"triangulate\": %.6f, \"dual\": %.6f, \"total_area\": %.15g, \"bytes_per_site\": %.1f, "
      "\"rungs\": [%llu, %llu, %llu, %llu]}\n",
      sites.size(), triangulation.num_vertices(), triangulation.num_faces(), triangulated - start,
      report.order_seconds, report.triangulate_seconds, dual, total_area,
      static_cast<double>(after - before) * 1024 / n,
      static_cast<unsigned long long>(report.rungs.filter),
      static_cast<unsigned long long>(report.rungs.double_double),
      static_cast<unsigned long long>(report.rungs.exact),
      static_cast<unsigned long long>(report.rungs.perturbed));
}
