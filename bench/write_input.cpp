// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// write_input KIND N FILE.npy: an input as an array (n, 3) of doubles, for peers in other
// languages.

#include <cstdio>
#include <cstdlib>

#include "inputs.h"
#include "rondel/io.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: write_input KIND N FILE.npy\n");
    return 2;
  }
  const auto sites = rondel::bench::make_input(argv[1], std::strtoull(argv[2], nullptr, 10));
  rondel::write_sites(argv[3], sites);
}
