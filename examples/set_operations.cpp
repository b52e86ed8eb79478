// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Two boxes, one across the date line and one around it: their union, and what only one of them has.

#include "rondel/set_operations.h"

#include <cstdio>
#include <exception>

#include "rondel/regions.h"
#include "rondel/rondel.h"

namespace {

rondel::CellRings box(double west, double south, double east, double north) {
  rondel::CellRings cells;
  for (const rondel::LonLat& corner : {rondel::LonLat{west, south}, rondel::LonLat{east, south},
                                       rondel::LonLat{east, north}, rondel::LonLat{west, north}}) {
    cells.corners.push_back(static_cast<rondel::Index>(cells.points.size()));
    cells.points.push_back(rondel::unit_vector(corner));
  }
  cells.end_ring();
  cells.end_cell();
  return cells;
}

void print(const char* what, const rondel::CellRings& region) {
  std::printf("%s: %d rings, %d corners, %.9f steradians\n", what,
              static_cast<int>(region.rings.size() - 1), static_cast<int>(region.corners.size()),
              rondel::areas(region)[0]);
}

void combine_boxes() {
  const rondel::CellRings wide = box(160, -10, 200, 10);
  const rondel::CellRings high = box(170, -40, 190, 40);
  const rondel::CellRings both = rondel::combine(wide, high, rondel::SetOperation::intersection);
  const rondel::CellRings any = rondel::combine(wide, high, rondel::SetOperation::unite);
  const rondel::CellRings one = rondel::combine(any, both, rondel::SetOperation::difference);
  print("both", both);
  print("any", any);
  print("one", one);
}

}  // namespace

int main() {
  try {
    combine_boxes();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "set_operations: %s\n", error.what());
    return 1;
  }
}
