// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Three sites on one great circle, within a hemisphere.
//
// in    three points and the center of the sphere
// out   whether one lies between the others
// index none
#pragma once

#include "rondel/types.h"

namespace rondel::bulk {

enum class Between { no, yes, below };

// Whether the ray of m lies strictly between those of a and b, exactly; `below` if also m lies in
// the triangle of a, b and the center, so that m can be hidden. Precondition: three rays in one
// plane with the center, in an open half plane.
Between is_between(const Point& a, const Point& m, const Point& b, const Point& center);

}  // namespace rondel::bulk
