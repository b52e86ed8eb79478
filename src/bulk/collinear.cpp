// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/collinear.h"

#include "exact/integer.h"

namespace rondel::bulk {

Between is_between(const Point& a, const Point& m, const Point& b, const Point& center) {
  const auto v = exact::scaled_differences({a, m, b}, center);
  const auto ab = cross(v[0], v[2]);
  if (dot(cross(v[0], v[1]), ab) <= 0 || dot(cross(v[1], v[2]), ab) <= 0) return Between::no;
  return dot(cross(v[1] - v[0], v[2] - v[0]), ab) > 0 ? Between::yes : Between::below;
}

}  // namespace rondel::bulk
