// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whether a closed surface is the boundary of the convex hull of its perturbed vertices.
//
// The surface is looked at from one of its vertices, the pole, which is an extreme point. If
// 1. every face without the pole has the pole below it,
// 2. the link of the pole winds once around a polygon that is star-shaped from its first vertex,
// 3. every edge is convex: the apex of one face is not above the face across,
// then the surface is the boundary. docs/theory/check.md has the proof. Each of the
// three also holds for the boundary of the hull, so what is refused is wrong.
#pragma once

#include <string>

#include "proof/perturbed_sites.h"
#include "proof/surface.h"
#include "rondel/types.h"

namespace rondel::proof {

// The first violation in one line, or nothing. At least 4 vertices; the pole is a vertex.
std::string find_concavity(const Surface& surface, const PerturbedSites& sites, Index pole,
                           Model model);

}  // namespace rondel::proof
