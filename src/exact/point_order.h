// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lexicographic order of points, for whoever looks them up by their coordinates.
#pragma once

#include <tuple>

#include "rondel/types.h"

namespace rondel::exact {

inline bool is_less(const Point& p, const Point& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

}  // namespace rondel::exact
