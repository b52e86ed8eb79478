// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites that stay where they are while others move.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::mesh {

// Throws InvalidInput with the first place that is not finite or the center; `what` begins the message.
void require_places(std::span<const Point> places, const char* what);

std::vector<Point> unit_places(std::span<const Point> places);

// Puts a site at each place, in their order: the nearest that none has taken yet. Returns which; throws InvalidInput for two
// places in one. Precondition: there are no more places than sites, all of which are unit vectors.
std::vector<Index> take_nearest(std::vector<Point>& sites, std::span<const Point> places,
                                unsigned threads);

}  // namespace rondel::mesh
