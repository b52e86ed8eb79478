// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// phases_bench KIND N BUILDS [projected|weighted] [SEED]: builds with one thread, each of an input of
// its own, of a kind of inputs/kinds.h; the first one has this seed. Valgrind counts what happens in
// them (suite/phases.py). By itself the program prints the processor time of a site, in ns.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "inputs/kinds.h"
#include "measure.h"
#include "rondel/rondel.h"

namespace {

double processor_ns() {
  return 1e9 * static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

}  // namespace

int main(int argc, char** argv) {
  const rondel::inputs::Kind* const kind = argc < 4 ? nullptr : rondel::inputs::find_kind(argv[1]);
  if (kind == nullptr) {
    std::fprintf(stderr, "usage: phases_bench KIND N BUILDS [projected|weighted] [SEED]\n");
    return 2;
  }
  rondel::inputs::Recipe recipe;
  recipe.n = std::strtoull(argv[2], nullptr, 10);
  if (argc > 5) recipe.seed = std::strtoull(argv[5], nullptr, 10);
  const int builds = std::atoi(argv[3]);
  rondel::Options options;
  if (argc > 4 && std::string(argv[4]) == "weighted") options.model = rondel::Model::weighted;
  rondel::bench::keep_freed_memory();
  std::size_t num_faces = 0;
  std::vector<double> ns;
  // The clock of processors has steps of microseconds, so that small inputs are built in groups.
  constexpr std::size_t enough_sites = 1U << 16;
  for (int done = 0; done < builds;) {
    std::vector<std::vector<rondel::Point>> inputs;
    std::size_t num_sites = 0;
    while (done < builds && num_sites < enough_sites) {
      inputs.push_back(rondel::inputs::make(*kind, recipe).sites);
      ++recipe.seed;
      num_sites += inputs.back().size();
      ++done;
    }
    const double start = processor_ns();
    for (const auto& sites : inputs) {
      num_faces +=
          rondel::delaunay(rondel::Sites::view(sites), options, {.threads = 1}).num_faces();
    }
    ns.push_back((processor_ns() - start) / static_cast<double>(num_sites));
  }
  rondel::bench::print_json({{"faces", static_cast<double>(num_faces)},
                             {"least", *std::ranges::min_element(ns)},
                             {"median", rondel::bench::median(ns)}});
}
