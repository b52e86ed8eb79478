// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Converts the sites to points of CGAL.
#pragma once

#include <vector>

#include "inputs.h"

namespace rondel::bench {

template <class Kernel>
std::vector<typename Kernel::Point_3> cgal_points(const std::vector<Point>& sites) {
  std::vector<typename Kernel::Point_3> points;
  points.reserve(sites.size());
  for (const Point& p : sites) points.emplace_back(p.x, p.y, p.z);
  return points;
}

}  // namespace rondel::bench
