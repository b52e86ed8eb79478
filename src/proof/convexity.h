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

#include <span>
#include <string>

#include "proof/perturbed_sites.h"
#include "proof/surface.h"
#include "rondel/types.h"

namespace rondel::proof {

// The first violation in one line, or nothing. At least 4 vertices; the pole is a vertex.
std::string find_concavity(const Surface& surface, const PerturbedSites& sites, Index pole,
                           Model model);

// Whether the sites that are no vertices lie below a convex surface, each found by a walk.
//
// Seen from the pole, the faces without it tile a convex polygon, and their surface is the graph of
// a concave function over it, so that the tiling is regular: a walk that crosses any edge with
// the site strictly beyond it ends (the height of the face's plane over the
// site falls with each step), in the face over which the site lies or in a face of the pole, which
// then has the site above it. Near sites follow each other, so walks are short.

// The first of the `candidates` (lowest indices of places, no vertices) that lies above a face, in
// one line, or nothing. The surface has passed find_concavity() with the same pole.
std::string find_uncovered(const Surface& surface, const PerturbedSites& sites, Index pole,
                           std::span<const Index> candidates);

}  // namespace rondel::proof
