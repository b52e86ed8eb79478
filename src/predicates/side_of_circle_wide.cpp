// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The determinant of the four unit vectors with a last column of ones, times the lengths of the rays,
// has the rows (x, y, z, |r|). Its first column taken from the last leaves the height over the
// plane of y and z,
//
//     h = |r| - x = (y^2 + z^2) / (|r| + x),
//
// where nothing cancels. With x_q / x_o times the row of one ray o taken from that of each other ray
// q, the first column has nothing but x_o, and three rows are left,
//
//     (x_o y_q - x_q y_o, x_o z_q - x_q z_o, x_o h_q - x_q h_o) / x_o,
//
// those of the planar in-circle test if x_o = x_q = 1. Where the coordinates of rays near the axis
// of x are of all magnitudes, little cancels if o is the nearest one.
#include <algorithm>
#include <array>
#include <cstddef>

#include "predicates/side_of_circle.h"
#include "predicates/wide.h"

namespace rondel::predicates {
namespace {

// The even permutation of the four whose last one has its axis in common with most, and is the
// nearest to it of those.
OrderOfFour order_for_nearest_to_axis(const std::array<WideRay, 4>& rays) {
  constexpr int farther = 1 << 24;  // than any distance
  std::array<int, 4> merits{};
  for (std::size_t i = 0; i < 4; ++i) {
    merits[i] -= rays[i].distance;
    for (std::size_t j = 0; j < i; ++j) {
      if (rays[i].axis != rays[j].axis || rays[i].is_backward != rays[j].is_backward) continue;
      merits[i] += farther;
      merits[j] += farther;
    }
  }
  return *std::ranges::max_element(even_orders_of_four, {},
                                   [&](const OrderOfFour& o) { return merits[o[3]]; });
}

}  // namespace

Sign side_of_circle_wide_filter(const Quad& q, const Point& center) {
  const Vector o = to_vector(center);
  const std::array<WideRay, 4> rays = {WideRay(to_vector(q[0]) - o), WideRay(to_vector(q[1]) - o),
                                       WideRay(to_vector(q[2]) - o), WideRay(to_vector(q[3]) - o)};
  const OrderOfFour order = order_for_nearest_to_axis(rays);
  const WideRay& origin = rays[order[3]];
  const bool is_reflected = origin.is_backward;
  const auto of_origin = origin.row(origin.axis, is_reflected);
  const auto row = [&](std::size_t i) {
    return less_origin(rays[order[i]].row(origin.axis, is_reflected), of_origin);
  };
  const Sign sign = det_of_rows(row(0), row(1), row(2)).sign_if_beyond(circle_wide_bound);
  return is_reflected ? -sign : sign;
}

}  // namespace rondel::predicates
