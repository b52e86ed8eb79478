// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_input KIND N FILE.npy [--seed S]: writes an input as an array (n, 3) of doubles, for peers
// in other languages.

#include <cstdio>
#include <cstdlib>

#include "inputs.h"
#include "rondel/io.h"

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc != 4) {
    std::fprintf(stderr, "usage: write_input KIND N FILE.npy [--seed S]\n");
    return 2;
  }
  rondel::bench::Source source(argv[1], argv[2], seed);
  rondel::write_sites(argv[3], source.next());
}
