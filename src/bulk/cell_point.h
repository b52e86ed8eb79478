// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A site as divide and conquer sees it, see cell_sites.h.
#pragma once

#include "rondel/types.h"

namespace rondel::bulk {

// With four numbers an index becomes an address by a shift.
struct alignas(32) CellPoint {
  double u;
  double v;
  double w;
  double size;  // s/z
};

struct CellVector {
  double u;
  double v;
  double w;
};

inline CellVector operator-(const CellPoint& a, const CellPoint& b) {
  return {a.u - b.u, a.v - b.v, a.w - b.w};
}
inline double dot(const CellVector& a, const CellVector& b) {
  return a.u * b.u + a.v * b.v + a.w * b.w;
}
inline CellVector cross(const CellVector& a, const CellVector& b) {
  return {a.v * b.w - a.w * b.v, a.w * b.u - a.u * b.w, a.u * b.v - a.v * b.u};
}

}  // namespace rondel::bulk
