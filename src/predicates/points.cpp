// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/points.h"

#include <cmath>

namespace rondel::predicates {

// bounds.h counts the roundings.
Vector direction(const Point& p, const Point& center) {
  const Vector v = exact::to_vector(p) - exact::to_vector(center);
  const double squared_length = dot(v, v);
  if (!(squared_length > 0x1p-600 && squared_length < 0x1p600)) {
    return exact::to_vector(exact::unit_vector(p, center).hi);
  }
  const double length = std::sqrt(squared_length);
  return {v.x / length, v.y / length, v.z / length};
}

}  // namespace rondel::predicates
