// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Disks around two sites near the pole, their union, and what remains of it without its border.

#include <cstdio>
#include <exception>
#include <vector>

#include "rondel/buffer.h"
#include "rondel/regions.h"
#include "rondel/rondel.h"
#include "rondel/set_operations.h"

namespace {

void print(const char* what, const rondel::CellRings& region) {
  double area = 0;
  for (const double part : rondel::areas(region)) area += part;
  std::printf("%s: %d rings, %d corners, %.9f steradians\n", what,
              static_cast<int>(region.rings.size() - 1), static_cast<int>(region.corners.size()),
              area);
}

void buffer_sites() {
  const std::vector<rondel::Point> sites = {rondel::unit_vector({-179, 89}),
                                            rondel::unit_vector({20, 88})};
  const rondel::CellRings disks = rondel::buffered(sites, {.distance = 0.03, .tolerance = 1e-4});
  const rondel::CellRings near = rondel::unite(disks);
  const rondel::CellRings inner = rondel::buffered(near, {.distance = -0.025, .tolerance = 1e-4});
  print("disks", disks);
  print("near", near);
  print("inner", inner);
}

}  // namespace

int main() {
  try {
    buffer_sites();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "buffers: %s\n", error.what());
    return 1;
  }
}
