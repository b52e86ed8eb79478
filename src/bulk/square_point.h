// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A site as divide and conquer sees it, see square_sites.h.
#pragma once

#include "rondel/types.h"

namespace rondel::bulk {

// With four numbers an index becomes an address by a shift.
struct alignas(32) SquarePoint {
  double u;
  double v;
  double w;
  double size;  // s/z
};

struct SquareVector {
  double u;
  double v;
  double w;
};

inline SquareVector operator-(const SquarePoint& a, const SquarePoint& b) {
  return {a.u - b.u, a.v - b.v, a.w - b.w};
}
inline double dot(const SquareVector& a, const SquareVector& b) {
  return a.u * b.u + a.v * b.v + a.w * b.w;
}
inline SquareVector cross(const SquareVector& a, const SquareVector& b) {
  return {a.v * b.w - a.w * b.v, a.w * b.u - a.u * b.w, a.u * b.v - a.v * b.u};
}

}  // namespace rondel::bulk
