// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
//
// Two boxes, one across the date line and one around it: their union, what only one of them has,
// and how they lie to each other, and a line that is divided by one of them.

#include "rondel/set_operations.h"

#include <cstdio>
#include <exception>

#include "rondel/geometries.h"
#include "rondel/regions.h"
#include "rondel/relate.h"
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

void relate_boxes() {
  const rondel::CellRings wide = box(160, -10, 200, 10);
  const rondel::CellRings high = box(170, -40, 190, 40);
  const rondel::Relation relation = rondel::relate(wide, high)[0];
  std::printf("wide and high: %.9s\n", relation.text().data());
  if (relation.is(rondel::SpatialPredicate::overlaps)) std::printf("they overlap\n");
  if (relation.matches("****0****")) std::printf("their sides meet in points\n");

  const rondel::RegionPieces pieces =
      rondel::overlay_pieces(wide, high, rondel::SetOperation::unite);
  for (const auto& [first, second, how] :
       rondel::related_pairs(pieces.rings, pieces.rings, rondel::SpatialPredicate::touches)) {
    if (first < second) std::printf("pieces %u and %u: %.9s\n", first, second, how.text().data());
  }
}

void clip_line() {
  const rondel::CellRings high = box(170, -40, 190, 40);
  rondel::Geometries lines;
  for (const double lon : {150.0, 175.0, 210.0}) {
    lines.lines.rows.values.push_back(rondel::unit_vector({lon, 0}));
  }
  lines.lines.rows.end_row();
  lines.lines.end_group();
  lines.polygons.end_cell();
  rondel::Geometries boxes{{}, high};
  boxes.lines.end_group();
  const auto inside = rondel::combine(lines, boxes, rondel::SetOperation::intersection);
  const auto outside = rondel::combine(lines, boxes, rondel::SetOperation::difference);
  std::printf("inside: %d line, %.9f radians\n", static_cast<int>(inside.lines.rows.size()),
              rondel::lengths(inside.lines)[0]);
  std::printf("outside: %d lines, %.9f radians\n", static_cast<int>(outside.lines.rows.size()),
              rondel::lengths(outside.lines)[0]);
}

}  // namespace

int main() {
  try {
    combine_boxes();
    relate_boxes();
    clip_line();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "set_operations: %s\n", error.what());
    return 1;
  }
}
