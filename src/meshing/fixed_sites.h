// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that stay where they are while others move.
//
// in    fixed places, as any vectors; sites as unit vectors
// out   the index of the site that was put at each place
// index places in their order; sites
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::mesh {

// Throws InvalidInput with the first place that is not finite or is the origin; `what` begins the
// message.
void require_places(std::span<const Point> places, const char* what);

// Returns the places as unit vectors.
std::vector<Point> unit_places(std::span<const Point> places);

// Returns the places as unit vectors; those that are unit vectors already stay bit by bit.
std::vector<Point> kept_units(std::span<const Point> places);

// Moves a site to each place, in their order: the nearest site that has not been taken yet. Returns
// the indices of the sites. Throws InvalidInput if two places are the same. Precondition: there are
// no more places than sites, and all sites are unit vectors.
std::vector<Index> take_nearest(std::vector<Point>& sites, std::span<const Point> places,
                                unsigned threads);

}  // namespace rondel::mesh
