// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/points.h"

#include <cmath>
#include <cstdint>

#include "system/wide_vectors.h"

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

void directions(std::span<const Point> points, const Point& center, Vector* result) {
  const auto origin = exact::to_vector(center);
  std::uint64_t is_sure = ~std::uint64_t{0};
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    std::uint64_t all = ~std::uint64_t{0};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector v = exact::to_vector(points[i]) - origin;
      const double squared_length = dot(v, v);
      const double length = std::sqrt(squared_length);
      result[i] = {v.x / length, v.y / length, v.z / length};
      all &= system::mask(squared_length > 0x1p-600) & system::mask(squared_length < 0x1p600);
    }
    is_sure = all;
  });
  if (is_sure != 0) return;
  for (const Point& p : points) *result++ = direction(p, center);
}

}  // namespace rondel::predicates
