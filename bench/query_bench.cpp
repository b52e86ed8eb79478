// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// query_bench N QUERIES [projected|weighted] [THREADS] [--seed S]: measures queries with uniform
// sites and as many other uniform points, in one batch of each kind. Prints one JSON object, whose
// check sum, that of the nearest sites' indices, is the same for every program.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <span>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/rondel.h"

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: query_bench N QUERIES [projected|weighted] [THREADS] [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t q = std::strtoull(argv[2], nullptr, 10);
  const auto points = rondel::bench::make_input("uniform", n + q, seed);
  const auto sites = std::span(points).first(n);
  const auto queries = std::span(points).last(q);
  rondel::Options options;
  if (argc > 3 && std::strcmp(argv[3], "weighted") == 0) options.model = rondel::Model::weighted;
  const unsigned threads = argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 1;

  const rondel::bench::Stopwatch build_watch;
  const auto triangulation = rondel::delaunay(sites, options);
  const double build = build_watch.seconds();
  const rondel::bench::Stopwatch locator_watch;
  const rondel::Locator locator(triangulation);
  const double prepare = locator_watch.seconds();

  using rondel::bench::seconds_of;
  std::vector<rondel::Index> nearest;
  const double nearest_seconds =
      seconds_of([&] { nearest = locator.nearest(queries, {.threads = threads}); });
  const double locate_seconds =
      seconds_of([&] { static_cast<void>(locator.locate(queries, {.threads = threads})); });
  constexpr std::size_t k = 8;
  const double k_nearest_seconds =
      seconds_of([&] { static_cast<void>(locator.k_nearest(queries, k, {.threads = threads})); });
  std::uint64_t single_sum = 0;
  const double single_seconds = seconds_of([&] {
    for (const rondel::Point& p : queries) single_sum += locator.nearest(p);
  });
  const auto sum = std::accumulate(nearest.begin(), nearest.end(), std::uint64_t{0});
  if (sum != single_sum) return 1;
  rondel::bench::print_json({{"sites", static_cast<double>(n)},
                             {"queries", static_cast<double>(q)},
                             {"build", build},
                             {"locator", prepare},
                             {"seconds", nearest_seconds},
                             {"locate", locate_seconds},
                             {"k_nearest_8", k_nearest_seconds},
                             {"single", single_seconds},
                             {"sum", static_cast<double>(sum)}});
}
