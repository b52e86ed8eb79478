// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings around a pole that straight lines in longitude and latitude do not mean.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "rondel/types.h"

namespace rondel::overlay {

// The number of the only side that spans more than half a turn, of a ring on one side of the equator: along the
// shorter way there the ring would go around the pole. Nothing if there is none,
// it lies at the pole, or between two sides along meridians, as that of a box.
std::optional<std::size_t> lone_long_side(std::span<const LonLat> ring);

}  // namespace rondel::overlay
