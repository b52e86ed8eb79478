// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// dynamic_bench KIND N [projected|weighted] [--seed S]: measures a build of all sites at once,
// their insertion one by one in random order without hints, and their removal in another random
// order. Prints one JSON object.

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "inputs.h"
#include "inputs/random.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"

namespace {

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: dynamic_bench KIND N [projected|weighted] [--seed S]\n");
    return 2;
  }
  auto sites = rondel::bench::Source(argv[1], argv[2], seed).next();
  rondel::inputs::Random random(~seed);
  random.shuffle(sites);
  rondel::Options options;
  if (argc > 3 && std::strcmp(argv[3], "weighted") == 0) options.model = rondel::Model::weighted;

  const double before = peak_bytes();
  rondel::DynamicTriangulation changing(options);
  std::vector<rondel::Index> ids;
  ids.reserve(sites.size());
  const double insert = rondel::bench::seconds_of([&] {
    for (const rondel::Point& p : sites) ids.push_back(changing.insert(p));
  });
  const double memory = peak_bytes() - before;
  const std::size_t vertices = changing.num_vertices();
  random.shuffle(ids);
  const double remove = rondel::bench::seconds_of([&] {
    for (const rondel::Index id : ids) changing.remove(id);
  });
  const double bulk = rondel::bench::seconds_of(
      [&] { rondel::delaunay(rondel::Sites::view(sites), options, {.threads = 1}); });

  const auto n = static_cast<double>(sites.size());
  std::printf(
      "{\"sites\": %zu, \"vertices\": %zu, \"bulk\": %.6f, \"insert\": %.6f, \"remove\": %.6f, "
      "\"insert_by_bulk\": %.2f, \"remove_by_bulk\": %.2f, \"bytes_per_site\": %.1f, \"left\": "
      "%zu}\n",
      sites.size(), vertices, bulk, insert, remove, insert / bulk, remove / bulk, memory / n,
      changing.num_sites());
}
