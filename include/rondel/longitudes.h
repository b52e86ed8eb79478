// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The turn of the globe in which files have their longitudes: -180 to 180, 0 to 360, or another one
/// (target rondel::geo).
#pragma once

#include <algorithm>
#include <cmath>

#include "rondel/export.h"

namespace rondel {

/// The least and the greatest of longitudes in degrees, as they are given; of none, infinities.
struct LongitudeExtent {
  double least = HUGE_VAL;
  double greatest = -HUGE_VAL;

  [[nodiscard]] bool is_empty() const { return !(least <= greatest); }
  /// Widens the extent to that of both.
  void include(const LongitudeExtent& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
  friend bool operator==(const LongitudeExtent&, const LongitudeExtent&) = default;
};

/// Returns where the turn begins in which results have their longitudes, such that they are those of
/// the input:
///
/// 1. -180 for longitudes from -180 to 180, and if there are none;
/// 2. else 0 for longitudes from 0 to 360;
/// 3. else the least longitude if they span at most 360 degrees, as -280 to 80 do, or 350 to 370;
/// 4. else -180.
///
/// Of the turns from -180 and from 0 one meridian has two longitudes. Results have 180 there, and 0;
/// but -180 where `given` has it and does not reach 180, and 360 where it has that and does not reach
/// 0: then the turn begins 1e-5 degrees beside that meridian.
///
/// Longitudes may exceed these limits by 1e-6 degrees, as rounded ones do.
/// \param given  of what surrounds the results
/// \param otherwise  decides if `given` is empty
RONDEL_API double west_of(const LongitudeExtent& given, const LongitudeExtent& otherwise = {});

}  // namespace rondel
