// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_input KIND N FILE.npy [CONSTRAINTS EDGES.csv] [--seed S]: writes an input as an array (n, 3)
// of doubles, for peers in other languages; and, if wanted, constraints between its sites, those of
// constrained_bench, as lines of two indices.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "constraints.h"
#include "inputs.h"
#include "rondel/io.h"

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc != 4 && argc != 6) {
    std::fprintf(stderr, "usage: write_input KIND N FILE.npy [CONSTRAINTS EDGES.csv] [--seed S]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  const std::vector<rondel::Point> sites = source.next();
  rondel::write_sites(argv[3], sites);
  if (argc == 4) return 0;
  std::ofstream edges(argv[5]);
  const auto wanted = static_cast<std::size_t>(std::atoll(argv[4]));
  for (const auto& [a, b] : rondel::bench::random_constraints(sites, wanted)) {
    edges << a << ',' << b << '\n';
  }
  return edges ? 0 : 1;
}
