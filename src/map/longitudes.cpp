// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "map/longitudes.h"

#include <cmath>

#include "rondel/longitudes.h"

namespace rondel {
namespace map {

constexpr double lon_rounding_deg = 1e-6;

double longitude_in_turn(double lon_deg, double west_deg) {
  if (west_deg == -180) return lon_deg;
  const double turns = std::ceil((west_deg - lon_rounding_deg - lon_deg) / 360);
  return turns == 0 ? lon_deg : lon_deg + 360 * turns;
}

}  // namespace map

double west_of(const LongitudeExtent& given, const LongitudeExtent& otherwise) {
  const LongitudeExtent& all = given.is_empty() ? otherwise : given;
  if (all.is_empty()) return -180;
  const auto is_in_turn_from = [&](double west_deg) {
    return all.least >= west_deg - map::lon_rounding_deg &&
           all.greatest <= west_deg + 360 + map::lon_rounding_deg;
  };
  const auto is_at = [](double lon_deg, double meridian_deg) {
    return std::abs(lon_deg - meridian_deg) <= map::lon_rounding_deg;
  };
  constexpr double beside_deg = 1e-5;
  if (is_in_turn_from(-180)) {
    const bool is_west = is_at(given.least, -180) && given.greatest < 180 - 2 * beside_deg;
    return is_west ? -180 - beside_deg : -180;
  }
  if (is_in_turn_from(0)) {
    const bool is_east = is_at(given.greatest, 360) && given.least > 2 * beside_deg;
    return is_east ? beside_deg : 0;
  }
  return is_in_turn_from(all.least) ? all.least : -180;
}

}  // namespace rondel
