// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/ray_order.h"

#include <array>

#include "exact/expansion.h"
#include "exact/integer.h"
#include "predicates/filtered.h"

namespace rondel::predicates {
namespace {

template <class T, class Size, class Compare>
Sign compare_slopes(const std::array<T, 3>& a, const std::array<T, 3>& b, Size size,
                    Compare compare_products) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (size(a[axis]) < size(a[i])) axis = i;
  }
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const Sign sign = compare_products(a[u], b[axis], b[u], a[axis]);
  return sign != Sign::zero ? sign : compare_products(a[v], b[axis], b[v], a[axis]);
}

}  // namespace

Sign compare_rays(const Point& a, const Point& b, const Point& center) {
  if (a == b) return Sign::zero;
  if (center == Point{} && is_safe_for_expansions({a, b})) {
    using exact::expansion;
    using exact::two_product;
    return compare_slopes<double>(
        {a.x, a.y, a.z}, {b.x, b.y, b.z}, [](double v) { return std::abs(v); },
        [](double p, double q, double r, double s) {
          return sign_of(expansion(two_product(p, q)) - expansion(two_product(r, s)));
        });
  }
  using exact::Integer;
  const auto v = exact::scaled_rays({a, b}, center);
  return compare_slopes<Integer>(
      {v[0].x, v[0].y, v[0].z}, {v[1].x, v[1].y, v[1].z},
      [](const Integer& c) { return Integer(abs(c)); },
      [](const Integer& p, const Integer& q, const Integer& r, const Integer& s) {
        return exact::sign_of(Integer(p * q - r * s));
      });
}

bool are_on_one_ray(const Point& a, const Point& b, const Point& center) {
  const auto v = exact::scaled_rays({a, b}, center);
  return exact::is_zero(cross(v[0], v[1])) && dot(v[0], v[1]) > 0;
}

}  // namespace rondel::predicates
