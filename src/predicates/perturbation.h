// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The last rung of the conflict test: ties are broken as if each site P_i had been moved along its
// ray, by an infinitesimal of its own.
//
//   projected: lowered to P_i (1 - e_i); the e of a site whose key is smaller is infinitely larger.
//              The keys are hashed coordinates, so the corners of a facet are cut off in random
//              order: no site has many neighbors in it, and a new site changes few of its faces.
//   weighted:  raised to P_i (1 + e_i); the e of a lexicographically smaller site is infinitely
//              larger. No such motion makes a vertex of a site in the middle of others.
//
// When four sites lie in one plane with the center, no such motion leaves the plane; then each is
// also lowered towards, or raised from, a point g strictly inside the hull, infinitely less.
// docs/theory/perturbation.md derives the rules and proves that they do not depend on g.
#pragma once

#include <cstdint>

#include "rondel/types.h"

namespace rondel::predicates {

// Whether p is in conflict with the face (b, c, d), given that the conflict test is exactly zero.
// Preconditions: as is_in_conflict in rondel/predicates.h.
bool is_in_conflict_perturbed(const Point& b, const Point& c, const Point& d, const Point& p,
                              Model model, const Point& center);

// The order of the infinitesimals in the projected model: by key, then lexicographic.
bool is_lowered_more(const Point& a, const Point& b);

// A hash of the coordinates, in which -0 is 0. It is part of the definition of every result with
// ties, and so fixed for ever, for all machines.
std::uint64_t lowering_key(const Point& p);

// The lexicographic order of the coordinates, that of the infinitesimals in the weighted model.
bool is_lexicographically_less(const Point& a, const Point& b);

}  // namespace rondel::predicates
