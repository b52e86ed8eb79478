// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Compares the hashes of results with those that are recorded, on a machine that has the public
// interface of the library and a C library, and little else.
//
//     same_bytes_of EXPECTED SETS      SETS: as `same_bytes EXPECTED --write-sets SETS` makes it

#include <cstdio>
#include <exception>

#include "same_bytes/portable/hashes.h"
#include "same_bytes/portable/site_sets.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: same_bytes_of EXPECTED SETS\n", stderr);
    return 2;
  }
  try {
    using namespace rondel::test;
    return num_different(argv[1], hash_lines(read_site_sets(argv[2]))) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "same_bytes_of: %s\n", error.what());
    return 1;
  }
}
