// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Longitudes in the turn of the globe that results have (rondel/longitudes.h).
//
// in    degrees from -180 to 180, as lonlats() returns them
// out   degrees
#pragma once

namespace rondel::map {

// Returns the longitude of the same meridian in the turn that begins at `west_deg`, which is in the
// turn itself; of -180 it is not, but 180 is. A longitude that rounding has moved to the west of the
// beginning stays there.
double longitude_in_turn(double lon_deg, double west_deg);

}  // namespace rondel::map
