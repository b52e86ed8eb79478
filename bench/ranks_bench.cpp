// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ranks_bench KIND N RANKS [--seed S]: measures what each phase of a build by ranks costs each
// rank, in processor time and in bytes sent to others. Ranks are simulated: one runs at a time with
// one thread, so the figures do not depend on the number of cores. For comparison it measures the
// build of the same sites in memory with one thread. Prints JSON for scripts/bench --scale-model.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <span>
#include <string>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "inputs.h"
#include "measure.h"
#include "rondel/distributed.h"
#include "rondel/rondel.h"
#include "support/simulated_ranks.h"

namespace {

using rondel::Point;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct InMemory {
  double seconds = 0;
  std::size_t num_faces = 0;
};

InMemory build_in_memory(std::span<const Point> sites) {
  const double start = processor_seconds();
  const auto triangulation = rondel::delaunay(rondel::Sites::view(sites), {}, {.threads = 1});
  return {processor_seconds() - start, triangulation.num_faces()};
}

struct OnRanks {
  std::uint64_t num_faces = 0;
  std::uint64_t num_open_sites = 0;
};

OnRanks build_on_ranks(rondel::test::SimulatedRanks& ranks, std::size_t num_ranks,
                       std::span<const Point> sites) {
  OnRanks result;
  const auto errors = ranks.run([&](rondel::Communicator& rank) {
    const auto r = static_cast<std::size_t>(rank.rank());
    const std::size_t begin = sites.size() * r / num_ranks;
    const std::size_t end = sites.size() * (r + 1) / num_ranks;
    const auto part =
        rondel::delaunay(rank, sites.subspan(begin, end - begin), {}, {}, {.threads = 1});
    if (r == 0) result = {part.num_faces(), part.num_open_sites()};
  });
  for (const std::string& error : errors) {
    if (error.empty()) continue;
    std::fprintf(stderr, "ranks_bench: %s\n", error.c_str());
    std::exit(1);
  }
  return result;
}

// The cost of a phase: for rank 0, which joins what the others leave open, and for the slowest of
// the others.
struct Phase {
  double first_seconds = 0;
  double max_seconds = 0;
  double all_seconds = 0;
  std::uint64_t first_bytes = 0;
  std::uint64_t max_bytes = 0;
  std::uint64_t all_bytes = 0;
  std::uint64_t num_calls = 0;
};

Phase sum_up(const rondel::test::SimulatedRanks& ranks, const char* name) {
  Phase phase;
  for (std::size_t r = 0; r < ranks.costs().size(); ++r) {
    const auto found = ranks.costs()[r].find(name);
    if (found == ranks.costs()[r].end()) continue;
    const rondel::test::PhaseCost& cost = found->second;
    phase.all_seconds += cost.cpu_seconds;
    phase.all_bytes += cost.bytes_sent;
    phase.num_calls = cost.num_calls;
    if (r == 0) {
      phase.first_seconds = cost.cpu_seconds;
      phase.first_bytes = cost.bytes_sent;
    } else {
      phase.max_seconds = std::max(phase.max_seconds, cost.cpu_seconds);
      phase.max_bytes = std::max(phase.max_bytes, cost.bytes_sent);
    }
  }
  return phase;
}

void print(std::size_t num_sites, const OnRanks& on_ranks, const InMemory& in_memory,
           const rondel::test::SimulatedRanks& ranks) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "{\"sites\": %zu, \"ranks\": %zu, \"open_sites\": %llu, \"seconds_in_memory\": %.6g,\n",
      num_sites, ranks.costs().size(), number(on_ranks.num_open_sites), in_memory.seconds);
  std::printf(" \"phases\": [");
  const char* separator = "\n";
  for (const char* name : {"count", "scatter", "triangulate", "join", "number", "finish"}) {
    const Phase phase = sum_up(ranks, name);
    std::printf(
        "%s  {\"phase\": \"%s\", \"first_seconds\": %.4g, \"max_seconds\": %.4g, "
        "\"all_seconds\": %.4g,\n   \"first_bytes\": %llu, \"max_bytes\": %llu, "
        "\"all_bytes\": %llu, \"calls\": %llu}",
        separator, name, phase.first_seconds, phase.max_seconds, phase.all_seconds,
        number(phase.first_bytes), number(phase.max_bytes), number(phase.all_bytes),
        number(phase.num_calls));
    separator = ",\n";
  }
  std::printf("\n ]}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  const int num_ranks = argc == 4 ? std::atoi(argv[3]) : 0;
  if (num_ranks < 1) {
    std::fprintf(stderr, "usage: ranks_bench KIND N RANKS [--seed S]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  const std::vector<Point> sites = source.next();
  rondel::bench::keep_freed_memory();
#if defined(__GLIBC__)
  mallopt(M_ARENA_MAX, 1);  // one arena for all threads, of which one runs
#endif
  rondel::test::SimulatedRanks ranks(num_ranks);
  build_on_ranks(ranks, static_cast<std::size_t>(num_ranks), sites);  // fills the heap
  const OnRanks on_ranks = build_on_ranks(ranks, static_cast<std::size_t>(num_ranks), sites);
  build_in_memory(sites);
  const InMemory in_memory = build_in_memory(sites);
  if (on_ranks.num_faces != in_memory.num_faces) return 1;
  print(sites.size(), on_ranks, in_memory, ranks);
}
