// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps from a target to sites in double-double arithmetic.
#pragma once

#include <span>
#include <vector>

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "rondel/types.h"

namespace rondel::interpolation {

using WideVector = exact::Vector3<exact::DoubleDouble>;

inline WideVector wide(const exact::SplitPoint& u) {
  return {exact::fast_two_sum(u.hi.x, u.lo.x), exact::fast_two_sum(u.hi.y, u.lo.y),
          exact::fast_two_sum(u.hi.z, u.lo.z)};
}

// x - u from split points, so right to 2^-99.
inline WideVector wide_step(const exact::SplitPoint& u, const exact::SplitPoint& x) {
  const auto difference = [](double a_hi, double a_lo, double b_hi, double b_lo) {
    return exact::two_diff(b_hi, a_hi) + exact::two_diff(b_lo, a_lo);
  };
  return {difference(u.hi.x, u.lo.x, x.hi.x, x.lo.x), difference(u.hi.y, u.lo.y, x.hi.y, x.lo.y),
          difference(u.hi.z, u.lo.z, x.hi.z, x.lo.z)};
}

// The steps from the direction of a point to those of sites, none of which is the same, seen from the
// center, right to 2^-90 of each: steps[k] times the power of two that is returned. The longest has a
// coordinate between 1/2 and 1.
double exact_wide_steps(const Point& from, std::span<const Point> sites, const Point& center,
                        std::vector<WideVector>& steps);

}  // namespace rondel::interpolation
