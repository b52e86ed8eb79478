// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// graphs_bench N [THREADS] [--seed S]: measures the graphs of uniform sites, in nanoseconds a
// Delaunay edge. Every repetition has its own points; prints the medians as one JSON object.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/graphs.h"
#include "rondel/outlines.h"

namespace {

using rondel::GraphKind;
using rondel::bench::seconds_of;

constexpr int repetitions = 5;
constexpr std::pair<const char*, GraphKind> kinds[] = {{"delaunay", GraphKind::delaunay},
                                                       {"urquhart", GraphKind::urquhart},
                                                       {"gabriel", GraphKind::gabriel},
                                                       {"relative", GraphKind::relative},
                                                       {"mst", GraphKind::spanning_tree}};

void run(std::size_t n, unsigned threads, std::uint64_t seed) {
  const rondel::Execution execution{.threads = threads};
  std::vector<std::vector<double>> seconds(std::size(kinds) + 2);
  for (int i = 0; i < repetitions; ++i) {
    const auto sites = rondel::bench::make_input("uniform", n, seed + static_cast<unsigned>(i));
    const auto triangulation = rondel::delaunay(sites, {}, execution);
    std::size_t size = 0;
    for (std::size_t k = 0; k < std::size(kinds); ++k) {
      seconds[k].push_back(seconds_of(
          [&] { size += site_graph(triangulation, kinds[k].second, execution).edges.size(); }));
    }
    seconds[std::size(kinds)].push_back(seconds_of(
        [&] { size += alpha_shape(triangulation, 1e-3, execution).rows.values.size(); }));
    seconds[std::size(kinds) + 1].push_back(
        seconds_of([&] { size += largest_empty_circles(triangulation, 10).size(); }));
    if (size == 0) std::abort();
  }
  const auto edges = static_cast<double>(3 * n - 6);
  std::printf(R"({"sites": %zu, "threads": %u, "ns_per_edge": {)", n, threads);
  const char* comma = "";
  const auto print = [&](const char* name, std::vector<double> times) {
    std::printf(R"(%s"%s": %.1f)", comma, name,
                rondel::bench::median(std::move(times)) / edges * 1e9);
    comma = ", ";
  };
  for (std::size_t k = 0; k < std::size(kinds); ++k) print(kinds[k].first, seconds[k]);
  print("alpha", seconds[std::size(kinds)]);
  print("circles", seconds[std::size(kinds) + 1]);
  std::printf("}}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 2) {
    std::fprintf(stderr, "usage: graphs_bench N [THREADS] [--seed S]\n");
    return 2;
  }
  const unsigned threads = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  rondel::bench::keep_freed_memory();
  run(std::strtoull(argv[1], nullptr, 10), threads, seed);
}
