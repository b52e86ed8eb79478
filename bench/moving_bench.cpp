// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// moving_bench KIND N [--share S] [--threads T] [--runs R] [--seed S] [projected|weighted]: moves all
// sites of a DynamicTriangulation, by up to the share S (0.1) of the spacing sqrt(4 pi / N) each, by
// move_all(); builds a triangulation of the moved sites; and makes a DynamicTriangulation of them.
// Each of R runs has other sites, and moves them twice. Prints one JSON object: medians of seconds.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <span>
#include <vector>

#include "inputs.h"
#include "inputs/random.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/dynamic.h"

namespace {

double option(int argc, char** argv, const char* name, double otherwise) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) return std::atof(argv[i + 1]);
  }
  return otherwise;
}

double median(std::vector<double>& values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Moves each site by a vector of a ball, and back to its distance from the center.
void move(std::span<rondel::Point> sites, double radius, rondel::inputs::Random& random) {
  for (rondel::Point& p : sites) {
    const rondel::Point step = random.in_ball();
    const double before = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    p = {p.x + radius * step.x, p.y + radius * step.y, p.z + radius * step.z};
    const double factor = before / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    p = {factor * p.x, factor * p.y, factor * p.z};
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: moving_bench KIND N [--share S] [--threads T] [--runs R] [--seed S] "
                 "[projected|weighted]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  const double share = option(argc, argv, "--share", 0.1);
  const auto threads = static_cast<unsigned>(option(argc, argv, "--threads", 1));
  const auto runs = static_cast<std::size_t>(option(argc, argv, "--runs", 3));
  rondel::Options options;
  if (std::strcmp(argv[argc - 1], "weighted") == 0) options.model = rondel::Model::weighted;
  rondel::inputs::Random random(~seed);
  std::vector<double> moves;
  std::vector<double> builds;
  std::vector<double> starts;
  std::size_t n = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    std::vector<rondel::Point> sites = source.next();
    n = sites.size();
    const double radius = share * std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
    rondel::DynamicTriangulation moving(sites, options);
    for (int step = 0; step < 2; ++step) {
      move(sites, radius, random);
      moves.push_back(
          rondel::bench::seconds_of([&] { moving.move_all(sites, {.threads = threads}); }));
      builds.push_back(rondel::bench::seconds_of(
          [&] { rondel::delaunay(rondel::Sites::view(sites), options, {.threads = threads}); }));
      starts.push_back(rondel::bench::seconds_of(
          [&] { const rondel::DynamicTriangulation again(sites, options, {.threads = threads}); }));
    }
  }
  const double move_time = median(moves);
  const double build_time = median(builds);
  const double start_time = median(starts);
  std::printf(
      "{\"sites\": %zu, \"threads\": %u, \"move_all\": %.6f, \"build\": %.6f, \"dynamic_build\": "
      "%.6f, \"move_all_by_build\": %.3f, \"move_all_by_dynamic_build\": %.3f}\n",
      n, threads, move_time, build_time, start_time, move_time / build_time,
      move_time / start_time);
}
