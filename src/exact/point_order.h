// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lexicographic order of points, for whoever looks them up by their coordinates.
#pragma once

#include "rondel/types.h"

namespace rondel::exact {

inline bool is_less(const Point& p, const Point& q) {
  if (p.x != q.x) return p.x < q.x;
  if (p.y != q.y) return p.y < q.y;
  return p.z < q.z;
}

}  // namespace rondel::exact
