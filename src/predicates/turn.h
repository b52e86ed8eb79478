// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Turns in a plane that is seen along a coordinate axis.
//
// 1. turn is the sign of coordinate `axis` of (a-o) x (b-o), exactly.
// 2. Odd under exchange of a and b; zero for all axes if and only if o, a and b are collinear.
#pragma once

#include "rondel/types.h"

namespace rondel::predicates {

Sign turn(const Point& o, const Point& a, const Point& b, unsigned axis);

bool are_collinear(const Point& o, const Point& a, const Point& b);

}  // namespace rondel::predicates
