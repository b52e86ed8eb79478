// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The order of the coordinates along an axis of cells.
#pragma once

#include <span>
#include <string>

#include "rondel/export.h"

namespace rondel::io {

// Throws InvalidInput unless each value is beyond the one before it, on the same side for all of them: latitudes increase or decrease;
// longitudes do, or they go the shorter way around from each to the next, all east or all west. What is no number is passed over.
// `name` is that of a value in the message, "latitude".
RONDEL_API void require_order(std::span<const double> values, bool is_longitude,
                              const std::string& name);

}  // namespace rondel::io
