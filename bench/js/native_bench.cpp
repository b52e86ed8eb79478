// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// native_bench N [RUNS]: measures medians of the processor time of a build and of its diagram, with
// one thread, for the sites that bench/js/run.mjs makes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace {

// Lehmer's random number generator.
class Numbers {
 public:
  double next() {
    state_ = state_ * 48271 % 2147483647;
    return static_cast<double>(state_) / 2147483647.0;
  }

 private:
  std::uint64_t state_ = 48271;
};

std::vector<rondel::Point> uniform_sites(std::size_t n) {
  Numbers numbers;
  std::vector<rondel::Point> sites;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 2 * numbers.next() - 1;
    const double angle = 2 * std::numbers::pi * numbers.next();
    const double r = std::sqrt(1 - z * z);
    sites.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return sites;
}

double milliseconds_since(std::clock_t begin) {
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: native_bench N [RUNS]\n");
    return 2;
  }
  const auto sites = rondel::Sites(uniform_sites(static_cast<std::size_t>(std::atoi(argv[1]))));
  const int runs = argc > 2 ? std::atoi(argv[2]) : 9;
  std::vector<double> builds;
  std::vector<double> diagrams;
  for (int i = 0; i < runs; ++i) {
    std::clock_t begin = std::clock();
    const auto triangulation = rondel::delaunay(sites, {}, {.threads = 1});
    builds.push_back(milliseconds_since(begin));
    begin = std::clock();
    const auto diagram = rondel::diagram(triangulation, {.threads = 1});
    diagrams.push_back(milliseconds_since(begin));
  }
  std::printf("{\"build\": %.3f, \"diagram\": %.3f}\n", median(builds), median(diagrams));
}
