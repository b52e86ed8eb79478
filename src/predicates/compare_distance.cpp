// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "predicates/compare_distance.h"

#include <cstddef>
#include <optional>

#include "exact/exact_sign.h"
#include "exact/unit_vector.h"

namespace rondel::predicates {
namespace {

using exact::Ball;
using exact::DoubleDouble;

// The sign of pa sqrt(b2) - pb sqrt(a2), if it is known.
template <std::size_t N>
std::optional<Sign> sign_of_two_roots(const Ball<N>& pa, const Ball<N>& b2, const Ball<N>& pb,
                                      const Ball<N>& a2) {
  const std::optional<Sign> sign = pa.sign();
  const std::optional<Sign> other = pb.sign();
  if (!sign || !other) return std::nullopt;
  if (*sign != *other) return *sign > *other ? Sign::positive : Sign::negative;
  const bool are_equal = (a2 - b2).sign() == Sign::zero;
  const std::optional<Sign> size =
      are_equal ? (pa - pb).sign() : (pa * pa * b2 - pb * pb * a2).sign();
  if (!size) return std::nullopt;
  return are_equal ? *size : *sign * *size;
}

}  // namespace

Sign compare_angle_double_double(const exact::SplitPoint& a, const exact::SplitPoint& b,
                                 const exact::SplitPoint& p) {
  const DoubleDouble a2 = squared_chord(p, a);
  const DoubleDouble b2 = squared_chord(p, b);
  const double value = (b2 - a2).hi;
  constexpr double bound = angle_double_double_bound * angle_double_double_bound;
  return unless_unsure(value, value * value > bound * std::max(a2.hi, b2.hi));
}

Sign compare_angle_exact(const Point& a, const Point& b, const Point& p, const Point& center) {
  return exact::sign_of_sextic([&](const auto& step) {
    const auto to_a = step(center, a);
    const auto to_b = step(center, b);
    const auto to_p = step(center, p);
    return sign_of_two_roots(dot(to_p, to_a), dot(to_b, to_b), dot(to_p, to_b), dot(to_a, to_a));
  });
}

Sign compare_power_exact(const Point& a, const Point& b, const Point& p, const Point& center) {
  return exact::sign_of_cubic([&](const auto& step) { return dot(step(b, a), step(center, p)); });
}

}  // namespace rondel::predicates
