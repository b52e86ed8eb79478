// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Whether the sites that are no vertices lie below a convex surface, each found by a walk.
//
// Seen from the pole, the faces without it tile a convex polygon, and their surface is the graph of
// a concave function over it, so that the tiling is regular: a walk that crosses any edge with
// the site strictly beyond it ends (the height of the face's plane over the
// site falls with each step), in the face over which the site lies or in a face of the pole, which
// then has the site above it. Near sites follow each other, so walks are short.
#pragma once

#include <span>
#include <string>

#include "proof/perturbed_sites.h"
#include "proof/surface.h"
#include "rondel/types.h"

namespace rondel::proof {

// The first of the `candidates` (lowest indices of places, no vertices) that lies above a face, in
// one line, or nothing. The surface has passed find_concavity() with the same pole.
std::string find_uncovered(const Surface& surface, const PerturbedSites& sites, Index pole,
                           std::span<const Index> candidates);

}  // namespace rondel::proof
