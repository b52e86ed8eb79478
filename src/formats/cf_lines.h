// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks the order of the coordinates along an axis of cells.
//
// in    longitudes or latitudes in degrees, in the order of the cells
// out   an exception that names the first coordinate that is out of order
// index cells along the axis
#pragma once

#include <span>
#include <string>

namespace rondel::formats {

// Throws InvalidInput unless each value is beyond the one before it, in the same direction:
// latitudes increase or decrease; longitudes do, or they go the shorter way around from each to the
// next, all east or all west. Values that are NaN are passed over.
// \param is_longitude  whether values may jump by turns of 360 degrees
// \param name  the name of a value in the message, "latitude"
void require_order(std::span<const double> values, bool is_longitude, const std::string& name);

}  // namespace rondel::formats
