// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The squared distance of two unit vectors in double-double.
#pragma once

#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"

namespace rondel::predicates {

// |u-v|^2 of unit vectors known to 2^-100: off by at most 2^-97 |u-v| (docs/theory/filters.md).
inline exact::DoubleDouble squared_chord(const exact::SplitPoint& u, const exact::SplitPoint& v) {
  using exact::DoubleDouble;
  const exact::Vector3<DoubleDouble> d = {
      DoubleDouble{u.hi.x, u.lo.x} - DoubleDouble{v.hi.x, v.lo.x},
      DoubleDouble{u.hi.y, u.lo.y} - DoubleDouble{v.hi.y, v.lo.y},
      DoubleDouble{u.hi.z, u.lo.z} - DoubleDouble{v.hi.z, v.lo.z}};
  return dot(d, d);
}

}  // namespace rondel::predicates
