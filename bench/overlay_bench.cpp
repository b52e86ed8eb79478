// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// overlay_bench N M [THREADS] [--seed S] [--kind KIND]: conservative weights from the Voronoi cells of N
// sites to those of M others, and one JSON object on standard output: nanoseconds a cell for the
// partitions, made of triangulations that are there, and a piece for the overlay with its weights, of
// order 1 and 2. Every repetition has sites of its own, and medians count.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/remap.h"

namespace {

using rondel::bench::seconds_of;

constexpr std::uint64_t repetitions = 3;

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  const char* kind = "uniform";
  if (argc > 4 && std::strcmp(argv[argc - 2], "--kind") == 0) {
    kind = argv[argc - 1];
    argc -= 2;
  }
  if (argc < 3) {
    std::fprintf(stderr, "usage: overlay_bench N M [THREADS] [--seed S] [--kind KIND]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t m = std::strtoull(argv[2], nullptr, 10);
  const rondel::Execution execution{.threads =
                                        argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1};
  rondel::bench::keep_freed_memory();
  std::vector<double> partition_seconds;
  std::vector<double> first_seconds;
  std::vector<double> second_seconds;
  std::size_t num_pieces = 0;
  double sum = 0;
  for (std::uint64_t k = 0; k <= repetitions; ++k) {
    const auto sites = rondel::bench::make_input(kind, n, seed + 2 * k);
    const auto other_sites = rondel::bench::make_input(kind, m, seed + 2 * k + 1);
    const auto source = rondel::delaunay(sites, {}, execution);
    const auto target = rondel::delaunay(other_sites, {}, execution);
    std::vector<rondel::Partition> partitions;
    const double seconds = seconds_of([&] {
      partitions.push_back(rondel::Partition::voronoi(source, execution));
      partitions.push_back(rondel::Partition::voronoi(target, execution));
    });
    const auto remap = [&](unsigned order) {
      return seconds_of([&] {
        const auto result =
            rondel::remap(partitions[0], partitions[1], {.order = order}, execution);
        num_pieces = result.areas.size();
        sum += result.weights.values[0];
      });
    };
    const double first = remap(1);
    const double second = remap(2);
    if (k == 0) continue;  // has waited for memory
    partition_seconds.push_back(seconds);
    first_seconds.push_back(first);
    second_seconds.push_back(second);
  }
  const auto pieces = static_cast<double>(num_pieces);
  rondel::bench::print_json(
      {{"sources", static_cast<double>(n)},
       {"targets", static_cast<double>(m)},
       {"pieces", pieces},
       {"partition_ns_a_cell",
        1e9 * rondel::bench::median(partition_seconds) / static_cast<double>(n + m)},
       {"overlay_ns_a_piece", 1e9 * rondel::bench::median(first_seconds) / pieces},
       {"second_order_ns_a_piece", 1e9 * rondel::bench::median(second_seconds) / pieces},
       {"sum", sum}});
  return 0;
}
