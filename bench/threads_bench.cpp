// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// threads_bench KIND N [--threads T] [--seed S]: builds a triangulation as T (64) threads would, one
// piece of work after the other, and says what they would share and what only one of them would do.
// Prints JSON for scripts/bench --scale-model, in seconds of processor time: the parallel loops in their
// order, each with what one thread does alone before it, the pieces, all of them together, and the longest;
// and what is done alone behind the last loop.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "inputs.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "simulated_threads.h"

namespace rondel::bench {
namespace {

int run(int argc, char** argv) {
  const std::uint64_t seed = take_seed(argc, argv);
  const bool has_threads = argc == 5 && std::strcmp(argv[3], "--threads") == 0;
  const int threads = has_threads ? std::atoi(argv[4]) : 64;
  if ((argc != 3 && !has_threads) || threads < 1) {
    std::fprintf(stderr, "usage: threads_bench KIND N [--threads T] [--seed S]\n");
    return 2;
  }
  Source source(argv[1], argv[2], seed);
  const std::vector<Point> sites = source.next();
  keep_freed_memory();
  const auto build = [&] {
    delaunay(Sites::view(sites), {}, {.threads = static_cast<unsigned>(threads)});
  };
  build();  // fills the heap
  start_threads_ledger();
  build();
  const ThreadsLedger ledger = end_threads_ledger();
  std::printf(R"({"sites": %zu, "threads": %d, "shared": [)", sites.size(), threads);
  const char* separator = "\n";
  for (const SharedWork& work : ledger.shared) {
    std::printf(R"(%s  {"alone": %.6g, "pieces": %zu, "seconds": %.6g, "longest": %.6g})",
                separator, work.alone, work.num_pieces, work.seconds, work.longest);
    separator = ",\n";
  }
  std::printf("\n ],\n \"alone\": %.6g}\n", ledger.alone);
  return 0;
}

}  // namespace
}  // namespace rondel::bench

int main(int argc, char** argv) { return rondel::bench::run(argc, argv); }
