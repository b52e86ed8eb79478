// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// dynamic_bench KIND N [projected|weighted]: a build of all sites at once, then their
// insertion one by one in random order without hints, and their removal in another random
// order. One JSON object on standard output.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "inputs.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"

namespace {

template <class Work>
double seconds_of(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: dynamic_bench KIND N [projected|weighted]\n");
    return 2;
  }
  auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  std::mt19937_64 random(1);
  std::ranges::shuffle(sites, random);
  rondel::Options options;
  options.threads = 1;
  if (argc > 3 && std::strcmp(argv[3], "weighted") == 0) options.model = rondel::Model::weighted;

  const double before = peak_bytes();
  rondel::DynamicTriangulation changing(options);
  std::vector<rondel::Index> ids;
  ids.reserve(sites.size());
  const double insert = seconds_of([&] {
    for (const rondel::Point& p : sites) ids.push_back(changing.insert(p));
  });
  const double memory = peak_bytes() - before;
  const std::size_t vertices = changing.num_vertices();
  std::ranges::shuffle(ids, random);
  const double remove = seconds_of([&] {
    for (const rondel::Index id : ids) changing.remove(id);
  });
  const double bulk = seconds_of([&] { rondel::delaunay(sites, options); });

  const auto n = static_cast<double>(sites.size());
  std::printf(
      "{\"sites\": %zu, \"vertices\": %zu, \"bulk\": %.6f, \"insert\": %.6f, \"remove\": %.6f, "
      "\"insert_by_bulk\": %.2f, \"remove_by_bulk\": %.2f, \"bytes_per_site\": %.1f, \"left\": "
      "%zu}\n",
      sites.size(), vertices, bulk, insert, remove, insert / bulk, remove / bulk, memory / n,
      changing.num_sites());
}
