// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Detects rings around a pole that straight lines in longitude and latitude do not represent.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "rondel/types.h"

namespace rondel::overlay {

// Returns the index of the only side of a ring that spans more than 180 degrees of longitude, for a
// ring on one side of the equator: if this side led the other way round, the ring would go around
// the pole. Returns nothing if there is no such side, or if it lies at the pole, or if it is
// between two sides along meridians as a side of a box is.
std::optional<std::size_t> lone_long_side(std::span<const LonLat> ring);

}  // namespace rondel::overlay
