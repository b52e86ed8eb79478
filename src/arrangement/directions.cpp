// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Directions are compared first by the part of a turn from a reference, then with each other.
#include "arrangement/directions.h"

#include "exact/vector.h"
#include "rondel/predicates.h"

namespace rondel::arrangement {
namespace {

// True if two directions on one great circle are the same. An axis that is not in the plane of the
// circle is on the same side of it as seen along both.
bool is_same_direction(const Point& node, const Point& p, const Point& q) {
  for (const Point& axis : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
    const Sign side = orientation(node, p, axis);
    if (side != Sign::zero) return orientation(node, q, axis) == side;
  }
  return false;
}

}  // namespace

int part_of_turn(const Point& node, const Point& reference, const Point& p) {
  const Sign side = orientation(node, reference, p);
  if (side != Sign::zero) return side == Sign::positive ? 1 : 3;
  return is_same_direction(node, reference, p) ? 0 : 2;
}

int compare_directions(const Point& node, const Point& reference, const Point& p, const Point& q) {
  const int of_p = part_of_turn(node, reference, p);
  const int of_q = part_of_turn(node, reference, q);
  if (of_p != of_q) return of_p < of_q ? -1 : 1;
  if (of_p % 2 == 0) return 0;
  return -static_cast<int>(orientation(node, p, q));
}

// The half circles from a through b and from b through a have the arc in common.
bool is_between(const Point& a, const Point& b, const Point& p) {
  return is_same_direction(a, b, p) && is_same_direction(b, a, p);
}

bool is_path_crossed(const Point& a, const Point& b, const Point& p, const Point& q) {
  // Nodes on the arc are to the left of the path.
  const auto side = [&](const Point& node) {
    return orientation(p, q, node) == Sign::negative ? Sign::negative : Sign::positive;
  };
  const Sign first = side(a);
  return side(b) == -first && orientation(a, b, p) == -first && orientation(a, b, q) == first;
}

}  // namespace rondel::arrangement
