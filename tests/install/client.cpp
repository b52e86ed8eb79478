// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Does what clients of a library do beyond their program: catch exceptions that cross its border,
// ask its version, write a file. Compiled alone it is a program, with -DRONDEL_TEST_PLUGIN a
// plugin.

#include <rondel/io.h>
#include <rondel/rondel.h>

#include <cstdio>
#include <vector>

static_assert(RONDEL_VERSION ==
              10000 * RONDEL_VERSION_MAJOR + 100 * RONDEL_VERSION_MINOR + RONDEL_VERSION_PATCH);

extern "C" int rondel_client() {
  const std::vector<rondel::Point> sites = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  int num_caught = 0;
  try {
    rondel::polar_point(sites[0], -1);
  } catch (const rondel::InvalidInput&) {
    ++num_caught;
  }
  try {
    rondel::read_sites("/nonexistent/sites.csv");
  } catch (const rondel::FileError&) {
    ++num_caught;
  }
  rondel::SiteTable table;
  table.name = "sites.csv";
  if (table.where(0) != "sites.csv:1") return 1;
  std::printf("%s: %zu faces, %d errors\n", rondel::version, rondel::delaunay(sites).num_faces(),
              num_caught);
  return 0;
}

#if !defined(RONDEL_TEST_PLUGIN)
int main() { return rondel_client(); }
#endif
