// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The last rung of the conflict test: ties are broken as if each site P_i had been raised
// along its ray to P_i (1 + e_i), where e_i > 0 is infinitesimal and infinitely
// larger for the lexicographically smaller site. When four sites lie in one plane
// with the center, no such motion leaves the plane; then each is also raised from a
// point g strictly inside the hull, infinitely less. docs/theory/perturbation.md
// derives the rules and proves that they do not depend on g.
#pragma once

#include "rondel/types.h"

namespace rondel::predicates {

// Whether p is in conflict with the face (b, c, d), given that the conflict test is exactly zero.
// Preconditions: as is_in_conflict in rondel/predicates.h.
bool is_in_conflict_perturbed(const Point& b, const Point& c, const Point& d, const Point& p,
                              Model model, const Point& center);

// The order of the infinitesimals: the lexicographic order of the coordinates.
bool is_raised_more(const Point& a, const Point& b);

}  // namespace rondel::predicates
